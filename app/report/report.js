// Reads the result and puts the sections on the page.

const SECTIONS = [
  ["layout", "Flat layout", layoutSection],
  ["space", "Folded shape in 3D", spaceSection],
  ["errors", "Error along the curve", errorSection],
  ["tilts", "Tilts per column", tiltSection],
  ["search", "Convergence of the search", searchSection],
  ["fidelity", "Speed against error", fidelitySection],
  ["plan", "Plan and provenance", planSection],
];

const PRINT_WIDTH = 680;

function section(id, title, content) {
  return html("section", {id}, html("h2", {}, title), content ?? missing("This part could not be made."));
}

function build(data) {
  document.title = `${data.name} \u2013 KinetiX design report`;
  const page = document.getElementById("report");
  page.append(guarded(() => headline(data)) ?? html("h1", {}, data.name));
  for (const [id, title, make] of SECTIONS) page.append(section(id, title, guarded(() => make(data))));
  drawAll();
}

/** Paper is white whatever the screen's colours are. */
function prepareForPaper(printing) {
  if (printing)
    document.documentElement.dataset.theme = "light";
  else
    delete document.documentElement.dataset.theme;
  drawAll(true, printing ? PRINT_WIDTH : 0);
}

function keepDrawn() {
  window.addEventListener("resize", () => drawAll());
  window.addEventListener("beforeprint", () => prepareForPaper(true));
  window.addEventListener("afterprint", () => prepareForPaper(false));
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => drawAll(true));
}

function start() {
  window.addEventListener("error", (event) => problem(`Error in this page: ${event.message}`));
  const raw = guarded(() => JSON.parse(document.getElementById("result").textContent));
  if (raw) guarded(() => build(readResult(dictionary(raw))));
  keepDrawn();
  document.documentElement.dataset.ready = "true";
}

start();
