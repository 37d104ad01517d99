// First screen: pictures of the folded and the flat sheet, verdict, sizes in mm, force, print tolerance.

const LONG_SHEET = 3;         // ratio of width to height: longer sheets are below the folded picture, not beside it
const SHOT_HEIGHT = 300;      // largest height, CSS pixels: both pictures and the verdict fit a screen of 800
const SHOT_MARGIN = 10;       // CSS pixels around a picture
const FOLDED_COLUMN = 1.35;   // column width of the folded picture over that of the flat one, as in the style sheet
const NARROW = "(max-width: 700px)";  // screens with one picture below the other, as in the style sheet
const FIRST_SLANT = [-0.55, 0.42], FIRST_TOP = [0, 1.1];  // azimuth and elevation, rad
const MOST_FACES = 6000;      // faces of bodies per picture: more take a browser seconds; the view in space shows them

/** Returns whether a panel may be rotated in its plane. That is so without plates, which align its sides. */
function liesAslant({view, equilibrium, goal, states}) {
  if (view !== "top" || !states.flat) return false;
  return equilibrium ? equilibrium.drive !== DRIVES.plates : finite(goal?.angle) !== null;
}

/** Returns a map that rotates a panel in its plane to the best fit with its flat bodies. */
function squarePlace({states: {model, flat}}) {
  const inPlane = ({p: [x, y]}) => [x, y], {move} = planeMotion(model.poses.map(inPlane), flat.poses.map(inPlane));
  return ([x, y, z]) => [...move([x, y]), z];
}

/** Returns a map that puts the bottom along x and y. @param corners bottom bodies: one, and others along x and y */
function bottomPlace({states: {model: {poses}}}, corners) {
  const [origin, along, across] = corners.map((k) => poses[k].p), x = unit(subtract(along, origin));
  const normal = unit(cross(x, subtract(across, origin))), rest = subtract(mean(poses.map(({p}) => p)), origin);
  const up = scale(normal, dot(rest, normal) < 0 ? -1 : 1), y = cross(up, x);
  return (p) => [x, y, up].map((axis) => dot(p, axis));
}

/** Returns a map into the frame of the goal: a strip is aligned with its curve, a box stands on its bottom. */
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

const standing = new WeakMap();  // cache by state, for facts and pictures

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

/** Returns the goal lines next to the folded sheet: both edges of a strip's curve, or the lines of a head. */
function firstGoal(data) {
  const {model} = data.states, lines = data.goal?.backdrop ?? [], goal = seenFromSide(data) ? data.goal?.goal ?? [] : [];
  if (goal.length < 2) return lines;
  const {place} = sideView(data), ys = model.poses.map((pose) => pose.p[1]), line = goal.map(place);
  return [...lines, ...[Math.min(...ys), Math.max(...ys)].map((y) => line.map(([x, z]) => [x, y, z]))];
}

/** Returns height and map of a drawing of this width, with the points in the middle. */
function fitted(points, width, perMm) {
  const box = extent(points), height = box.size[1] * perMm + 2 * SHOT_MARGIN, left = (width - box.size[0] * perMm) / 2;
  return {height, to: ([x, y]) => [left + (x - box.low[0]) * perMm, SHOT_MARGIN + (box.high[1] - y) * perMm]};
}

/** Returns whether the outside of a face points to the eye. */
function isFaced([a, b, c], eye) {
  return dot(cross(subtract(b, a), subtract(c, a)), eye.away) < 0;
}

/** Returns a picture: its label, its points in mm and its drawing function. Null for bodies with too many faces. */
function foldedShot(data, state = data.states.model, label = "The folded structure") {
  const {isBodies} = data.structure;
  if (data.kind?.standing && data.states.flat) return data.kind.standing(data);
  const eye = camera(...(data.view === "top" ? FIRST_TOP : FIRST_SLANT)), project = (p) => [dot(p, eye.right), dot(p, eye.up)];
  const seen = standingPlates(data, state).filter(({corners}) => !isBodies || isFaced(corners, eye));
  if (isBodies && !(seen.length > 0 && seen.length <= MOST_FACES)) return null;
  const shapes = seen.map((plate) => ({
    polygon: outline(plate, project), depth: dot(mean(plate.corners), eye.away), corners: plate.corners, mesh: plate.mesh
  }));
  const depths = new Map();  // depth per body or soft part, because each of them is sorted as a whole
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

/** Returns the largest scale at which a picture fits, CSS pixels per mm. */
function shotScale({points}, width) {
  const {size} = extent(points);
  return Math.min((width - 2 * SHOT_MARGIN) / (size[0] || 1), (SHOT_HEIGHT - 2 * SHOT_MARGIN) / (size[1] || 1));
}

/** Draws a picture at the common scale of both pictures. @param wider ratio of the other picture's column width */
function drawShot(shot, other, width, wider) {
  const perMm = Math.min(shotScale(shot, width), other ? shotScale(other, width * wider) : Infinity), {to, height} = fitted(shot.points, width, perMm);
  return drawing(width, height, shot.label, shot.marks(to));
}

/** Returns the edges of the box around all walls, mm. */
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

/** Returns the parts of the console's line of sizes that the pictures do not have: " at 30 deg", "collision-free to 40 deg". */
function sizeParts({summary}) {
  const text = summary.find(({label}) => label === "size")?.text ?? "", [sizes, ...rest] = text.split("; ");
  return {angle: / at [^ ]+ deg$/.exec(sizes)?.[0] ?? "", range: rest.join("; ")};
}

/** Returns the lines of the console as rows, except the sizes, which are taken from the pictures. */
function summaryFacts({summary}) {
  return summary.filter(({label}) => label !== "size" && label !== "bodies").map(({label, text}) => [capital(label), text]);
}

function printText({print}) {
  if (!print) return null;
  const minutes = Math.max(1, Math.round(print.seconds / 60)), hours = Math.floor(minutes / 60);
  const time = hours ? `${hours} h ${minutes % 60} min` : `${minutes} min`, times = print.prints > 1 ? ` in ${print.prints} prints` : "";
  return `${time}, ${figures(print.material / 1000, 2)} cm\u00b3${times}, by ${print.process} with ${print.hinges}s, estimated by PrusaSlicer`;
}

function firstFacts(data) {
  const {structure, states} = data, {isBodies} = structure, walls = `walls ${millimetres(structure.thickness)} thick, ${millimetres(structure.height)} high`;
  const isDrawn = plates(structure).length > 0;
  const rows = [
    [isBodies ? "At rest" : "Flat", isDrawn && states.flat && sizeText(boxOfPlates(standingFlat(data)))],
    [isBodies ? "Moved" : "Folded", isDrawn && states.model && sizeText(boxOfPlates(standingPlates(data, states.model))) + sizeParts(data).angle],
    isBodies ? ["Bodies", `${structure.bodies.length}, with ${count(structure.hinges.length, "hinge", "hinges")}`] : ["Sheet", `${cellsText(structure)}; ${walls}`],
    ["Walls", capital(sizeParts(data).range)],
    ...summaryFacts(data),
    ["Print time", printText(data)],
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

/** Lists problems, one sentence each: errors and the first warning, as on the console. Other warnings are collapsed. */
function problemLines({verdict: {errors, warnings}}) {
  const line = (level) => (text) => html("p", {class: "why"}, `${level}: ${text}`);
  const lines = [...errors.map(line("Error")), ...warnings.map(line("Warning"))], shown = lines.splice(0, Math.max(1, errors.length));
  if (lines.length) shown.push(html("details", {class: "warnings"}, html("summary", {}, count(lines.length, "more warning", "more warnings")), lines));
  return shown;
}

function firstScreen(data) {
  const {mark, tone, title} = verdict(data);
  return html(
      "header", {id: "headline"}, html("p", {class: "eyebrow"}, "KinetiX design report"), html("h1", {}, data.name),
      html("div", {class: "verdict " + tone}, html("span", {class: "mark", "aria-hidden": "true"}, mark),
           html("div", {}, html("h2", {}, title), problemLines(data))),
      guarded(() => firstShots(data)), guarded(() => firstFacts(data)));
}
