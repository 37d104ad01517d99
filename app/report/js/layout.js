// Flat layout: the sheet as it is printed, seen from above.

const CELL_PX = {
  least: 42,
  leastOfPanels: 20,  // for more rows than a strip has: lines of columns would hide the shape of a panel
  labelled: 38,       // larger cells have room for a tilt below their column
  most: 72
};
const STRIP_ROWS = 3;

function largestTilt(structure) {
  return Math.max(0, ...structure.hinges.map((hinge) => Math.abs(hinge.beta)));
}

/** Returns the columns per line. Cells stay legible and lines have nearly equal length. */
function wrapped({columns, rows}, room) {
  const least = rows > STRIP_ROWS ? CELL_PX.leastOfPanels : CELL_PX.least;
  const lines = Math.ceil(columns / Math.max(1, Math.floor(room / least)));
  const perLine = Math.ceil(columns / lines);
  return {lines: Math.ceil(columns / perLine), perLine, cellPx: Math.min(CELL_PX.most, room / perLine)};
}

function topRim(plate) {
  const [, , hingeTop, cornerTop] = plate.corners;
  return [
    add(hingeTop, plate.side), add(cornerTop, plate.side), subtract(cornerTop, plate.side),
    subtract(hingeTop, plate.side)
  ];
}

function flatWalls(structure, flat, to, hinges) {
  const cut = hinges.flatMap((hinge) => halfWalls(structure, hinge))
                  .map((plate) => carriedPlate(structure, flat, plate));
  const xy = (p) => to([p[0], p[1]]);
  return [
    svg("g", {class: "face"}, cut.map((plate) => svg("path", {d: path(outline(plate, xy), true)}))),
    svg("g", {class: "rim"}, cut.map((plate) => svg("path", {d: path(topRim(plate).map(xy), true)}))),
  ];
}

/** Returns the direction in which the top edge leans: w = cos(beta) z + sin(beta) (e x z). */
function leanOf(structure, hinge) {
  const from = structure.bodies[hinge.a].rest, to = structure.bodies[hinge.b].rest;
  const [x, y] = subtract(to, from), length = Math.hypot(x, y) || 1, sign = Math.sign(hinge.beta);
  return [sign * y / length, -sign * x / length];
}

function arrow([x, y], [dx, dy], length, fillColour) {
  const tip = [x + dx * length, y - dy * length], back = [x + dx * (length - 7), y - dy * (length - 7)];
  const wing = [4 * dy, 4 * dx];
  return svg(
      "g", {class: "lean"}, svg("path", {d: path([[x, y], back]), stroke: fillColour}),
      svg("path", {d: path([tip, add(back, wing), subtract(back, wing)], true), fill: fillColour}));
}

function hingeMark(structure, hinge, to, cellPx, largest) {
  const at = to(hinge.point), fillColour = tiltColour(hinge.beta, largest);
  const radius = Math.max(3.5, Math.min(6, cellPx * 0.09));
  const tilted = Math.abs(hinge.beta) > 1e-4;
  return svg(
      "g", {},
      svg("title", {},
          `${nameWall(hinge)}: tilt ${degrees(toDegrees(hinge.beta))}, hinge at ${figures(hinge.t, 2)} of the wall`),
      tilted ? arrow(at, leanOf(structure, hinge), cellPx * 0.34, fillColour) : null,
      svg("circle", {class: "hinge", cx: at[0], cy: at[1], r: radius, fill: fillColour}));
}

function columnLabel(c, x, y, below, text) {
  return [
    svg("text", {class: "column", x, y, "text-anchor": "middle"}, String(c)),
    text === null ? null : svg("text", {class: "tilt", x, y: below, "text-anchor": "middle"}, text),
  ];
}

function flatLine(data, line, wrap, largest) {
  const {structure} = data, first = structure.firstColumn + line * wrap.perLine;
  const last = Math.min(structure.firstColumn + structure.columns, first + wrap.perLine);
  const perMm = wrap.cellPx / structure.cell, side = 16, top = 26 + 0.3 * wrap.cellPx,
        deep = structure.rows * wrap.cellPx;
  const to = ([x, y]) =>
      [side + (x - first * structure.cell) * perMm,
       top + deep - (y - structure.firstRow * structure.cell) * perMm];
  const inside = structure.hinges.filter(
      (h) => h.column >= first && (h.along === "x" ? h.column < last : h.column <= last));
  const height = top + deep + 0.3 * wrap.cellPx + 24;
  const tilts = tiltsByColumn(structure), labelled = largest > 1e-4 && wrap.cellPx >= CELL_PX.labelled;
  const label = (c) => columnLabel(
      c, side + (c - first + 0.5) * wrap.cellPx, 13, height - 6,
      labelled && tilts.has(c) ? degrees(toDegrees(tilts.get(c).beta)) : null);
  return drawing(
      side * 2 + (last - first) * wrap.cellPx, height, `Flat layout, columns ${first} to ${last - 1}`,
      flatWalls(structure, data.states.flat, to, inside),
      inside.map((hinge) => hingeMark(structure, hinge, to, wrap.cellPx, largest)),
      Array.from({length: last - first}, (_, k) => label(first + k)));
}

/** Draws the whole sheet at once, for lattices without columns. */
function drawWhole(data, width) {
  const {structure} = data, margin = {left: 16, right: 16, top: 16, bottom: 16};
  const {to, height, perMm} = mapOf(structure.bodies.map((body) => body.rest), width, margin);
  const largest = largestTilt(structure);
  return drawing(
      width, height, "Flat layout", flatWalls(structure, data.states.flat, to, structure.hinges),
      structure.hinges.map((hinge) => hingeMark(structure, hinge, to, structure.cell * perMm, largest)));
}

function drawLayout(data, width) {
  if (!data.structure.isSquare) return drawWhole(data, Math.min(width, 720));
  const wrap = wrapped(data.structure, width - 32), largest = largestTilt(data.structure);
  const lines = Array.from({length: wrap.lines}, (_, line) => flatLine(data, line, wrap, largest));
  return html("div", {class: "lines"}, lines);
}

function tiltScale(largest) {
  const width = 250, bar = 200, x0 = 25, steps = 41;
  const swatch = (k) => svg("rect", {
    x: x0 + (k * bar) / steps,
    y: 8,
    width: bar / steps + 0.6,
    height: 12,
    fill: tiltColour((2 * k) / (steps - 1) - 1, 1)
  });
  const tick = (share) =>
      svg("text", {x: x0 + (bar * (share + 1)) / 2, y: 36, "text-anchor": "middle"},
          degrees(toDegrees(share * largest)));
  return drawing(
      width, 58, "Colour scale of wall tilts", Array.from({length: steps}, (_, k) => swatch(k)),
      svg("g", {class: "ticks"}, [-1, 0, 1].map(tick)),
      svg("text", {class: "label", x: x0 + bar / 2, y: 54, "text-anchor": "middle"},
          "tilt \u03b2 of the wall, degrees"));
}

function mostTilted(walls) {
  return walls.reduce((a, b) => (Math.abs(b.beta) > Math.abs(a.beta) + 1e-9 ? b : a));
}

/** Draws the front two walls of the most tilted column from the right end, at true angles. */
function drawEndView(structure) {
  const walls = structure.hinges.filter((h) => h.along === "x"), most = mostTilted(walls);
  const pair = walls.filter((h) => h.column === most.column).sort((a, b) => a.row - b.row).slice(0, 2);
  const px = 62 / structure.height, floor = 84, gap = Math.min(structure.cell * px, 106), x0 = 125 - gap / 2;
  const wall = (h, k) => {
    const foot = [x0 + k * gap, floor], lean = [-Math.sin(h.beta) * 62, -Math.cos(h.beta) * 62];
    return [
      svg("path", {
        class: "end",
        d: path([foot, add(foot, lean)]),
        "stroke-width": Math.max(3, structure.thickness * px)
      }),
      svg("path", {class: "upright", d: path([foot, [foot[0], floor - 78]])}),
      svg("text", {class: "tilt", x: foot[0], y: floor + 18, "text-anchor": "middle"},
          degrees(toDegrees(h.beta))),
      svg("text", {class: "column", x: foot[0], y: floor + 33, "text-anchor": "middle"},
          k === 0 ? "front" : "back"),
    ];
  };
  return html(
      "figure", {class: "inset"},
      drawing(
          250, 122, "Walls seen from the right end",
          svg("path", {class: "axis", d: path([[10, floor], [240, floor]])}), pair.map(wall)),
      html(
          "figcaption", {},
          `Column ${
              most.column}, the most tilted, seen from the right end. Positive tilt: the top leans to the front.`));
}

/** Describes hinge axes that lean within their walls; "" if there are none. */
function describeSlant({hinges}) {
  const slant = Math.max(0, ...hinges.map((hinge) => Math.abs(hinge.alpha - Math.PI / 2)));
  return slant > 1e-4 ? `; hinge axes lean within their walls by up to ${degrees(toDegrees(slant))}` : "";
}

/** Describes the largest offset of hinges across their walls; "" if it is zero. */
function describeHingeOffsets({hinges}) {
  const most = Math.max(0, ...hinges.map((hinge) => Math.abs(hinge.offset)));
  return most > 1e-6 ? `; hinges are up to ${millimetres(most)} to one side of the middle of their walls, across the wall` : "";
}

const LATTICE_NAMES = {graph: "cells of a drawing"};

/** Describes the number of cells. They may not fill all columns and rows. */
function describeSquares({columns, rows, cells, cell}) {
  if (!cells || cells === columns * rows) return `${columns} \u00d7 ${rows} cells of ${millimetres(cell)}`;
  return `${count(cells, "cell", "cells")} of ${millimetres(cell)} in ${count(columns, "column", "columns")} and ${count(rows, "row", "rows")}`;
}

/** Describes the cells and the overall size, including the thickness of walls. */
function describeSize(data) {
  const {structure} = data, [x, y] = boxOfPlates(standingFlat(data)).map(millimetres);
  const cells = structure.isSquare ?
      describeSquares(structure) :
      `${structure.cells} ${LATTICE_NAMES[structure.lattice] ?? `cells of a ${structure.lattice} lattice`}, ` +
          `cell edge ${millimetres(structure.cell)}`;
  return `${cells}, ${x} \u00d7 ${y}`;
}

/** Returns whether tilts in each column alternate in sign from row to row. They do in strips that bend. */
function tiltsAlternate({hinges}) {
  const leans = ({beta}) => (Math.abs(beta) > 1e-4 ? Math.sign(beta) : 0), columns = new Map();
  for (const hinge of hinges.filter(({along}) => along === "x").sort((a, b) => a.row - b.row))
    columns.set(hinge.column, [...(columns.get(hinge.column) ?? []), leans(hinge)]);
  return [...columns.values()].every((signs) => signs.every((sign, k) => k === 0 || sign === -signs[k - 1]));
}

function layoutSection(data) {
  const {structure} = data;
  if (!structure.hinges.length || !data.states.flat) return missing("This result holds no structure.");
  const wallText =
      `walls ${millimetres(structure.thickness)} thick and ${millimetres(structure.height)} high` +
      (structure.wallAssumed ? " (assumed for the picture)" : "");
  const largest = largestTilt(structure), tilted = largest > 1e-4;
  const keys = responsive(
      () => html(
          "div", {class: "keys"}, tiltScale(largest), structure.isSquare && structure.columns > 0 ? drawEndView(structure) : null));
  return [
    html(
        "p", {class: "lead"},
        `Printed flat: ${describeSize(data)}, ${wallText}. Front is at the bottom of the picture.`),
    responsive((width) => drawLayout(data, width)),
    tilted ? keys : null,
    tilted ? legend(
                 ["rim", "top edge of a wall"], ["face", "leaning face below it"],
                 ["dot", "hinge, coloured by tilt"], ["lean-key", "direction in which the wall\u2019s top leans"]) :
             legend(["rim", "wall, upright"], ["dot plain", "hinge"]),
    html(
        "p", {class: "note"},
        !tilted ? `All walls stand upright${describeSlant(structure)}${describeHingeOffsets(structure)}.` +
                (structure.isSquare ? " Above each column its number." : "") :
            structure.isSquare ?
                  "Above each column its number, below it the tilt of its front wall" +
                (structure.rows > 0 && tiltsAlternate(structure) ? "; from row to row the sign alternates." : ".") :
                  "Point at a hinge for its numbers."),
  ];
}
