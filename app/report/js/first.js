// The first screen: the thing folded, the flat sheet beside it, one sentence, sizes in mm, force, what prints come to.

const LONG_SHEET = 3;         // times as wide as high: such sheets lie below the folded thing instead of beside it
const SHOT_HEIGHT = 330;      // CSS pixels, at most: both pictures and the verdict fit a screen of 800
const SHOT_MARGIN = 10;       // CSS pixels around a picture
const FOLDED_COLUMN = 1.35;   // width of the column of the folded thing over that of the flat sheet, as in the style sheet
const NARROW = "(max-width: 700px)";  // where they stand one below the other, as in the style sheet
const FIRST_SLANT = [-0.55, 0.42], FIRST_TOP = [0, 1.1];  // azimuth and elevation, rad
const MOST_FACES = 6000;      // of bodies in a picture: more take a browser seconds, and the view in space shows them
const OWN_SPRINGS = "its own springs";  // as `effort` of results calls a drive that nobody presses

/** Whether no plates hold a panel's sides: its equilibrium then lies in its plane turned by whatever moved it. */
function liesAslant({view, equilibrium, goal, states}) {
  if (view !== "top" || !states.flat) return false;
  return equilibrium ? equilibrium.drive !== DRIVES.plates : finite(goal?.angle) !== null;
}

/** Turned in its plane so that its bodies lie as nearly as they can where they were flat. */
function squarePlace({states: {model, flat}}) {
  const inPlane = ({p: [x, y]}) => [x, y], {move} = planeMotion(model.poses.map(inPlane), flat.poses.map(inPlane));
  return ([x, y, z]) => [...move([x, y]), z];
}

/** A fold with its bottom along x and y and the rest above it. @param corners bodies of the bottom: one, and others along x and along y */
function bottomPlace({states: {model: {poses}}}, corners) {
  const [origin, along, across] = corners.map((k) => poses[k].p), x = unit(subtract(along, origin));
  const normal = unit(cross(x, subtract(across, origin))), rest = subtract(mean(poses.map(({p}) => p)), origin);
  const up = scale(normal, dot(rest, normal) < 0 ? -1 : 1), y = cross(up, x);
  return (p) => [x, y, up].map((axis) => dot(p, axis));
}

/** Into the frame that the goal was drawn in, where a strip stands as its curve does and a box on its bottom. */
function standingPlace(data) {
  if (liesAslant(data)) return squarePlace(data);
  const corners = data.states.model && data.kind?.bottom?.(data);
  if (corners) return bottomPlace(data, corners);
  if (!seenFromSide(data)) return (p) => p;
  const {place} = sideView(data);
  return ([x, y, z]) => {
    const [across, up] = place([x, z]);
    return [across, y, up];
  };
}

const standing = new WeakMap();  // by state: facts and pictures ask for the same

function standingPlates(data, state) {
  if (!standing.has(state)) standing.set(state, placedPlates(data, state));
  return standing.get(state);
}

function placedPlates(data, state) {
  const place = standingPlace(data);
  return plates(data.structure).map((plate) => {
    const {corners, side, ...rest} = carriedPlate(data.structure, state, plate);
    const [origin, tip] = [corners[0], add(corners[0], side)].map(place);
    return {...rest, corners: corners.map(place), side: subtract(tip, origin)};
  });
}

/** Goal lines that stand beside the thing: both edges of a strip's curve, the lines of a head. */
function firstGoal(data) {
  const {model} = data.states, lines = data.goal?.backdrop ?? [], goal = seenFromSide(data) ? data.goal?.goal ?? [] : [];
  if (goal.length < 2) return lines;
  const {place} = sideView(data), ys = model.poses.map((pose) => pose.p[1]), line = goal.map(place);
  return [...lines, ...[Math.min(...ys), Math.max(...ys)].map((y) => line.map(([x, z]) => [x, y, z]))];
}

/** In the middle of a drawing that is `width` wide. */
function fitted(points, width, perMm) {
  const box = extent(points), height = box.size[1] * perMm + 2 * SHOT_MARGIN, left = (width - box.size[0] * perMm) / 2;
  return {height, to: ([x, y]) => [left + (x - box.low[0]) * perMm, SHOT_MARGIN + (box.high[1] - y) * perMm]};
}

/** Whether a face is seen by the eye, from outside. */
function isFaced([a, b, c], eye) {
  return dot(cross(subtract(b, a), subtract(c, a)), eye.away) < 0;
}

/** A picture: what it takes up, mm, and what draws it; null of bodies with too many faces. */
function foldedShot(data, state = data.states.model, label = "The thing, folded") {
  const {isBodies} = data.structure;
  if (data.kind?.standing && data.states.flat) return data.kind.standing(data);
  const eye = camera(...(data.view === "top" ? FIRST_TOP : FIRST_SLANT)), project = (p) => [dot(p, eye.right), dot(p, eye.up)];
  const seen = standingPlates(data, state).filter(({corners}) => !isBodies || isFaced(corners, eye));
  if (isBodies && !(seen.length > 0 && seen.length <= MOST_FACES)) return null;
  const shapes = seen.map((plate) => ({
    polygon: outline(plate, project), depth: dot(mean(plate.corners), eye.away), corners: plate.corners, mesh: plate.mesh
  }));
  const depths = new Map();  // of bodies and soft parts, which hide each other as a whole
  for (const {mesh, depth} of shapes) depths.set(mesh, Math.max(depths.get(mesh) ?? -Infinity, mesh ? depth : 0));
  shapes.sort((a, b) => depths.get(b.mesh) - depths.get(a.mesh) || b.depth - a.depth);
  const lines = firstGoal(data).map((line) => line.map(project));
  const bare = (data.goal?.bare ?? []).map((line) => line.map(project));
  const fill = (corners) => litColour(corners, eye, colour("model-plate"), colour("model-shade"));
  return {
    label, points: [...shapes.flatMap(({polygon}) => polygon), ...lines.flat()],
    marks: (to) => [
      svg("g", {class: seenFromSide(data) ? "standing-goal" : "standing-head"}, lines.map((line) => svg("path", {d: path(line.map(to))}))),
      svg("g", {class: "bare"}, bare.map((line) => svg("path", {d: path(line.map(to))}))),
      svg("g", {class: "standing"}, shapes.map(({polygon, corners}) => svg("path", {d: path(polygon.map(to), true), style: isBodies ? `fill:${fill(corners)};stroke:${fill(corners)}` : `fill:${fill(corners)}`})))
    ]
  };
}

function flatShot({structure, states: {flat}}) {
  const half = structure.thickness / 2;
  return {
    label: "The flat sheet, from above", points: structure.bodies.flatMap(({rest: [x, y]}) => [[x - half, y - half], [x + half, y + half]]),
    marks: (to) => flatWalls(structure, flat, to, structure.hinges)
  };
}

/** The largest scale at which a picture fits, CSS pixels a mm. */
function shotScale({points}, width) {
  const {size} = extent(points);
  return Math.min((width - 2 * SHOT_MARGIN) / (size[0] || 1), (SHOT_HEIGHT - 2 * SHOT_MARGIN) / (size[1] || 1));
}

/** One scale for both pictures, so that they can be compared. @param wider how much wider the other picture's column is */
function drawShot(shot, other, width, wider) {
  const perMm = Math.min(shotScale(shot, width), other ? shotScale(other, width * wider) : Infinity), {to, height} = fitted(shot.points, width, perMm);
  return drawing(width, height, shot.label, shot.marks(to));
}

/** Edges of the box around walls, mm. */
function boxOfPlates(all) {
  const solid = all.flatMap(({corners, side}) => corners.flatMap((corner) => [add(corner, side), subtract(corner, side)]));
  return [0, 1, 2].map((k) => {
    let low = Infinity, high = -Infinity;
    for (const p of solid) low = Math.min(low, p[k]), high = Math.max(high, p[k]);
    return high - low;
  });
}

function sizeText(sizes) {
  return sizes.map((size) => figures(size)).join(" \u00d7 ") + " mm";
}

function cellsText(structure) {
  if (structure.isSquare && structure.cells === structure.columns * structure.rows) return `${structure.columns} \u00d7 ${structure.rows} cells of ${millimetres(structure.cell)}`;
  return `${count(structure.cells, "cell", "cells")}, edges of ${millimetres(structure.cell)}`;
}

/** What the drive needs, N or N mm, and of whom; nothing where no elastic model was run. */
function forceText({equilibrium, raw, asMade}) {
  if (!equilibrium) return takenForceText(asMade?.taken);
  const {effort} = raw.equilibrium, steps = list(raw.equilibrium.path).filter((step) => finite(step.load) !== null);
  if (effort === OWN_SPRINGS) return "nobody's: its own springs fold it";
  if (!steps.length) return null;
  const most = steps.reduce((a, {load}) => Math.max(a, Math.abs(load)), 0), unit = steps[0].load_unit === "N mm" ? `N${SPACE}mm` : "N";
  return `${figures(most, 2)} ${unit} at most` + (effort ? `: a matter for ${effort}` : "");
}

/** Of hinges that the file leaves open. */
function takenForceText(taken) {
  const load = someDictionary(taken?.load);
  if (!load || finite(load.value) === null) return null;
  const unit = load.unit === "N mm" ? `N${SPACE}mm` : "N";
  return `${figures(Math.abs(load.value), 2)} ${unit} with soft blocks in its hinges: a matter for ${load.effort}`;
}

/** Of hinges that are made as blocks or films. */
function strainText({metrics: {strain_max: most, strain_allowed: allowed}}) {
  if (finite(most) === null || finite(allowed) === null) return null;
  return `${figures(most, 2)} of the ${neat(allowed)} that the hinges' material bears${most > allowed ? ": more than it bears" : ""}`;
}

function asMadeText({asMade}) {
  if (!asMade) return null;
  return `${millimetres(asMade.rms)} off the goal by ${asMade.process}; 95 of 100 within ${millimetres(asMade.p95)}, allowed ${millimetres(asMade.tolerance)}`;
}

function printText({print}) {
  if (!print) return null;
  const minutes = Math.max(1, Math.round(print.seconds / 60)), hours = Math.floor(minutes / 60);
  const time = hours ? `${hours} h ${minutes % 60} min` : `${minutes} min`, times = print.prints > 1 ? ` in ${print.prints} prints` : "";
  return `${time}, ${figures(print.material / 1000, 2)} cm\u00b3${times}, by ${print.process} with ${print.hinges}s, as PrusaSlicer reckons`;
}

function firstFacts(data) {
  const {structure, states} = data, {isBodies} = structure, walls = `walls ${millimetres(structure.thickness)} thick, ${millimetres(structure.height)} high`;
  const isDrawn = plates(structure).length > 0;
  const rows = [
    [isBodies ? "At rest" : "Flat", isDrawn && states.flat && sizeText(boxOfPlates(standingFlat(data)))],
    [isBodies ? "Moved" : "Folded", isDrawn && states.model && sizeText(boxOfPlates(standingPlates(data, states.model)))],
    isBodies ? ["Bodies", `${structure.bodies.length}, with ${count(structure.hinges.length, "hinge", "hinges")}`] : ["Sheet", `${cellsText(structure)}; ${walls}`],
    ["Force", forceText(data)],
    ["Strain", strainText(data)],
    ["As made", asMadeText(data)],
    ["Print", printText(data)],
    ...(data.kind?.facts?.(data) ?? []),
  ].filter(([, value]) => value);
  return html("dl", {class: "first-facts"}, rows.map(([name, value]) => html("div", {}, html("dt", {}, name), html("dd", {}, value))));
}

function standingFlat({structure, states}) {
  return plates(structure).map((plate) => carriedPlate(structure, states.flat, plate));
}

function firstShots(data) {
  const {structure, states} = data;
  if (!structure.hinges.length) return missing("This result holds no structure to draw.");
  const rest = extent(structure.bodies.map(({rest: place}) => place)), isLong = rest.size[0] > LONG_SHEET * rest.size[1];
  const {isBodies} = structure, folded = states.model && foldedShot(data);
  const flat = states.flat && (isBodies ? foldedShot(data, states.flat, "The bodies at rest") : flatShot(data));
  const words = isBodies ? ["Moved", "at the scale of the bodies at rest", "At rest, as they were imported"] : ["Folded", "at the scale of the flat sheet", "Flat, as it is printed"];
  if (isBodies && !flat) return null;
  const wider = () => (isLong || window.matchMedia(NARROW).matches ? 1 : FOLDED_COLUMN);
  const figure = (draw, words) => html("figure", {}, responsive(draw), html("figcaption", {}, words));
  return html(
      "div", {class: isLong ? "first-shots long" : "first-shots"},
      folded ? figure((width) => drawShot(folded, flat, width, 1 / wider()), flat ? `${words[0]}, ${words[1]}` : words[0]) :
               missing("This result holds no complete folded state to draw."),
      flat ? figure((width) => drawShot(flat, folded, width, wider()), words[2]) : null);
}

/** Problems, a sentence each: all errors, and warnings that fold away where there are several problems. */
function problemLines({verdict: {errors, warnings}}) {
  const line = (level) => (text) => html("p", {class: "why"}, `${level}: ${text}`);
  const lines = warnings.map(line("Warning"));
  if (errors.length + lines.length > 1 && lines.length)
    return [...errors.map(line("Error")), html("details", {class: "warnings"}, html("summary", {}, count(lines.length, "warning", "warnings")), lines)];
  return [...errors.map(line("Error")), ...lines];
}

function firstScreen(data) {
  const {mark, tone, title} = verdict(data);
  return html(
      "header", {id: "headline"}, html("p", {class: "eyebrow"}, "KinetiX design report"), html("h1", {}, data.name),
      html("div", {class: "verdict " + tone}, html("span", {class: "mark", "aria-hidden": "true"}, mark),
           html("div", {}, html("h2", {}, title), problemLines(data))),
      guarded(() => firstShots(data)), guarded(() => firstFacts(data)));
}
