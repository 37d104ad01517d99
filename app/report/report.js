// Reads the result and puts the sections on the page.

const always = () => true;
const hasTarget = (data) => Boolean(data.raw.target);
const hasCurve = (data) => hasTarget(data) && data.display === null && data.fold === null && data.helmet === null;
const hasDisplay = (data) => data.display !== null;
const hasFold = (data) => data.fold !== null;
const hasHelmet = (data) => data.helmet !== null;
const hasStable = ({stable}) => stable.states.length > 1 || stable.unresolved.length > 0;
const hasBalance = (data) => data.balance !== null;

/** id, title, content, and when it has anything to say: without a target nothing was searched. */
const SECTIONS = [
  ["display", "What the panel shows", displaySection, hasDisplay],
  ["fold", "Net and creases", foldSection, hasFold],
  ["helmet", "How it fits the head", helmetSection, hasHelmet],
  ["load", "Load and energy along the drive", loadSection, hasBalance],
  ["stable", "Stable states", stableSection, hasStable],
  ["energy", "Where the energy is", energySection, hasBalance],
  ["layout", "Flat layout", layoutSection, (data) => !hasHelmet(data)],
  ["space", "Folded shape in 3D", spaceSection, always],
  ["errors", "Error along the curve", errorSection, hasCurve],
  ["tilts", "Tilts per column", tiltSection, (data) => hasCurve(data) || (!hasFold(data) && !hasHelmet(data) && largestTilt(data.structure) > 1e-4)],
  ["search", "Convergence of the search", searchSection, hasCurve],
  ["fidelity", "Speed against error", fidelitySection, (data) => hasTarget(data) || data.fidelity.length > 0],
  ["plan", "Plan and provenance", planSection, always],
];

const PRINT_WIDTH = 680;

function section(id, title, content) {
  return html("section", {id}, html("h2", {}, title), content ?? missing("This part could not be made."));
}

function build(data) {
  document.title = `${data.name} \u2013 KinetiX design report`;
  const page = document.getElementById("report");
  page.append(guarded(() => headline(data)) ?? html("h1", {}, data.name));
  for (const [id, title, make, isNeeded] of SECTIONS)
    if (isNeeded(data)) page.append(section(id, title, guarded(() => make(data))));
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
