// Reads the result and puts the sections on the page.

const always = () => true;
const hasStable = ({stable}) => stable.states.length > 1 || stable.unresolved.length > 0;
const hasEquilibrium = (data) => data.equilibrium !== null;
const hasHeat = (data) => hasEquilibrium(data) && !data.structure.isBodies;
const hasLayout = (data) => !data.kind?.hasNoLayout && !data.structure.isBodies;
const isTiltedDesign = (data) => !data.kind && largestTilt(data.structure) > 1e-4;
const hasFidelity = (data) => Boolean(data.raw.target) || data.fidelity.length > 0;

/** Sections: [id, title, function that makes the content, predicate: is it needed]. */
const SPACE_SECTION = ["space", "Turn it, fold it", spaceSection];
const CARD_SECTION = ["card", "How to fold it", cardSection, ({card}) => card !== null];
const GENERAL_SECTIONS = [
  ["load", "Load and energy along the drive", loadSection, hasEquilibrium],
  ["stable", "Stable states", stableSection, hasStable],
  ["layout", "Flat layout", layoutSection, hasLayout],
];
const CLOSING_SECTIONS = [
  ["prints", "Designs and their prints", robustChoiceSection, ({robustChoices}) => robustChoices.length > 0],
  ["contact", "Collision-free range", certifiedSection, (data) => data.certified !== null && !isProvenOfOthers(data)],
  ["contact", "Collision-free range of the ideal motion", certifiedSection, isProvenOfOthers],
  ["tilts", "Tilts per column", tiltSection, isTiltedDesign],
];
/** Collapsed sections with the origin and accuracy of the result. */
const DETAILS = [
  ["words", "The verdict in numbers", verdictSection, always],
  ["energy", "Where the energy is", energySection, hasHeat],
  ["search", "Convergence of the search", searchSection, ({runs}) => runs.length > 0],
  ["fidelity", "Speed against error", fidelitySection, hasFidelity],
  ["plan", "Plan and provenance", planSection, always],
];

function needed(data, sections) {
  return sections.filter(([, , , isNeeded]) => isNeeded(data));
}

function sectionsOf(data) {
  const {firstSections = [], lastSections = []} = data.kind ?? {};
  return [SPACE_SECTION, ...firstSections, ...needed(data, [CARD_SECTION]), ...needed(data, GENERAL_SECTIONS), ...lastSections, ...needed(data, CLOSING_SECTIONS)];
}

/** Makes the collapsed details. Their figures are drawn when they are first opened. */
function details(data) {
  const box = html("details", {id: "details", toggle: () => drawAll(true)}, html("summary", {}, "Details: numbers, search, speed against error, origin"));
  for (const [id, title, make] of needed(data, DETAILS)) box.append(section(id, title, guarded(() => make(data))));
  return box;
}

const PRINT_WIDTH = 680;

function section(id, title, content) {
  return html("section", {id}, html("h2", {}, title), content ?? missing("This part could not be made."));
}

function build(data) {
  document.title = `${data.name} \u2013 KinetiX design report`;
  const page = document.getElementById("report");
  page.append(guarded(() => firstScreen(data)) ?? html("h1", {}, data.name));
  for (const [id, title, make] of sectionsOf(data)) page.append(section(id, title, guarded(() => make(data))));
  page.append(details(data));
  drawAll();
}

/** Switches to light colours and opens all warnings for printing, and back. */
function prepareForPaper(printing) {
  for (const warnings of document.querySelectorAll(".warnings")) warnings.open = printing;
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
