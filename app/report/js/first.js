// The first screen: the thing folded, the flat sheet beside it, one sentence, sizes in mm, force, what prints come to.

const LONG_SHEET = 3;         // times as wide as high: such sheets lie below the folded thing instead of beside it
const SHOT_HEIGHT = 330;      // CSS pixels, at most: both pictures and the verdict fit a screen of 800
const FIRST_SLANT = [-0.55, 0.42], FIRST_TOP = [0, 1.1];  // azimuth and elevation, rad
const OWN_SPRINGS = "its own springs";  // as `effort` of results calls a drive that nobody presses

/** Into the frame that the goal was drawn in, where a strip stands as its curve does. */
function standingPlace(data) {
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

/** Equal scales, in the middle of a drawing. */
function fitted(points, width, most) {
  const box = extent(points), margin = 10;
  const perMm = Math.min((width - 2 * margin) / (box.size[0] || 1), (most - 2 * margin) / (box.size[1] || 1));
  const height = box.size[1] * perMm + 2 * margin, left = (width - box.size[0] * perMm) / 2;
  return {height, to: ([x, y]) => [left + (x - box.low[0]) * perMm, margin + (box.high[1] - y) * perMm]};
}

function drawStanding(data, width) {
  if (data.kind?.standing && data.states.flat) return data.kind.standing(data, width, SHOT_HEIGHT);
  const eye = camera(...(data.view === "top" ? FIRST_TOP : FIRST_SLANT)), project = (p) => [dot(p, eye.right), dot(p, eye.up)];
  const shapes = standingPlates(data, data.states.model).map((plate) => ({
    polygon: outline(plate, project), depth: dot(mean(plate.corners), eye.away),
    fill: litColour(plate.corners, eye, colour("model-plate"), colour("model-shade"))
  })).sort((a, b) => b.depth - a.depth);
  const lines = firstGoal(data).map((line) => line.map(project));
  const {to, height} = fitted([...shapes.flatMap(({polygon}) => polygon), ...lines.flat()], width, SHOT_HEIGHT);
  return drawing(
      width, height, "The thing, folded",
      svg("g", {class: seenFromSide(data) ? "standing-goal" : "standing-head"}, lines.map((line) => svg("path", {d: path(line.map(to))}))),
      svg("g", {class: "standing"}, shapes.map(({polygon, fill}) => svg("path", {d: path(polygon.map(to), true), style: `fill:${fill}`}))));
}

function drawFlatSheet(data, width) {
  const {structure, states: {flat}} = data, half = structure.thickness / 2;
  const corners = structure.bodies.flatMap(({rest: [x, y]}) => [[x - half, y - half], [x + half, y + half]]);
  const {to, height} = fitted(corners, width, SHOT_HEIGHT);
  return drawing(width, height, "The flat sheet, from above", flatWalls(structure, flat, to, structure.hinges));
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
  return finite(most) === null || finite(allowed) === null ? null : `${figures(most, 2)} of ${neat(allowed)} that the hinges' material bears`;
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
  const {structure, states} = data, walls = `walls ${millimetres(structure.thickness)} thick, ${millimetres(structure.height)} high`;
  const rows = [
    ["Flat", states.flat && sizeText(boxOfPlates(standingFlat(data)))],
    ["Folded", states.model && sizeText(boxOfPlates(standingPlates(data, states.model)))],
    ["Sheet", `${cellsText(structure)}; ${walls}`],
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
  const flat = extent(structure.bodies.map(({rest}) => rest)), isLong = flat.size[0] > LONG_SHEET * flat.size[1];
  const shot = (draw, words) => html("figure", {}, responsive(draw), html("figcaption", {}, words));
  return html(
      "div", {class: isLong ? "first-shots long" : "first-shots"},
      states.model ? shot((width) => drawStanding(data, width), "Folded") : missing("This result holds no complete folded state to draw."),
      states.flat ? shot((width) => drawFlatSheet(data, width), "Flat, as it is printed") : null);
}

/** What keeps a tick from being green, a sentence each. */
function madeReasons({madeFaults}, tone) {
  return tone === "unsure" && madeFaults ? madeFaults.why : [];
}

function firstScreen(data) {
  const {mark, tone, title} = verdict(data);
  return html(
      "header", {id: "headline"}, html("p", {class: "eyebrow"}, "KinetiX design report"), html("h1", {}, data.name),
      html("div", {class: "verdict " + tone}, html("span", {class: "mark", "aria-hidden": "true"}, mark),
           html("div", {}, html("h2", {}, title), madeReasons(data, tone).map((reason) => html("p", {}, reason)),
                reasons(data).map((reason) => html("p", {class: "why"}, reason)))),
      guarded(() => firstShots(data)), guarded(() => firstFacts(data)));
}
