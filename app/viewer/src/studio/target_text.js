// The text of a target.yaml (docs/formats.md) from what a person asked for. Lengths in mm, angles in degrees.

const GAP_DEG = 50;           // of a bracelet: where the wrist goes in
const BOX_CELLS = 4;          // along the shortest edge of a box, about
const MOST_BOX_CELLS = 40;    // along its longest one

const number = (value) => Number(Number(value).toFixed(3));
const pairs = (points) => `[${points.map(([x, y]) => `[${number(x)}, ${number(y)}]`).join(", ")}]`;
const inQuotes = (text) => `"${String(text).replace(/[\\"]/g, "\\$&")}"`;
const file = (name, target, rest = []) => [`kinetix: 1`, `name: ${name}`, `target: ${target}`, ...rest, ""].join("\n");

/** Points along an open circle round a wrist; the wall's outer half lies outside. */
export function braceletPoints(round_mm, height_mm, gap_deg = GAP_DEG) {
  const radius = round_mm / (2 * Math.PI) + height_mm / 2, start = -90 + gap_deg / 2, most = 72;
  return Array.from({length: most + 1}, (_, k) => {
    const angle = ((start + ((360 - gap_deg) * k) / most) * Math.PI) / 180;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
}

export function bracelet({round_mm, columns, rows, height_mm}) {
  const points = braceletPoints(round_mm, height_mm), length = Math.PI * (round_mm / Math.PI + height_mm) * (1 - GAP_DEG / 360);
  const thickness = number(Math.min(1.2, 0.1 * (length / columns)));
  return file("bracelet", `{kind: curve, points: ${pairs(points)}}`,
    [`structure: {cells: [${columns}, ${rows}], wall_mm: {thickness: ${thickness}, height: ${number(height_mm)}}}`]);
}

export function curve({points, columns, rows}) {
  return file("curve", `{kind: curve, points: ${pairs(points)}}`, [`structure: {cells: [${columns}, ${rows}]}`]);
}

export function curveFile({name, columns, rows}) {
  return file("curve", `{kind: curve, points: ${inQuotes(name)}}`, [`structure: {cells: [${columns}, ${rows}]}`]);
}

export function letter({glyph, cells, cell_mm}) {
  const plain = glyph.replace(/[^A-Za-z0-9]/g, "") || "letter";
  return file(plain, `{kind: display, glyph: ${inQuotes(glyph)}}`,
    [`structure: {cells: [${cells * Math.max(1, [...glyph].length)}, ${cells}], cell_mm: ${number(cell_mm)}}`]);
}

export function image({name, cell_mm, invert}) {
  return file("picture", `{kind: display, image: ${inQuotes(name)}${invert ? ", invert: true" : ""}}`, [`structure: {cell_mm: ${number(cell_mm)}}`]);
}

/** Cells of a box and their edge, so that its size in mm is met best. */
export function boxCells(size_mm) {
  const shortest = Math.min(...size_mm), most = Math.max(...size_mm);
  let best = null;
  for (let count = 1; count <= 2 * BOX_CELLS; ++count) {
    const edge = shortest / count, cells = size_mm.map((v) => Math.max(1, Math.round(v / edge)));
    if (most / edge > MOST_BOX_CELLS && best) break;
    const miss = Math.max(...size_mm.map((v, k) => Math.abs(cells[k] * edge - v) / v)) + 0.01 * Math.abs(count - BOX_CELLS);
    if (!best || miss < best.miss) best = {cells, edge, miss};
  }
  return best;
}

export function box({size_mm, open}) {
  const {cells, edge} = boxCells(size_mm);
  return file("box", `{kind: fold, box: [${cells.join(", ")}]${open ? `, open: ${open}` : ""}}`, [`structure: {cell_mm: ${number(edge)}}`]);
}

export function helmet({name, ribs, clearance_mm, units}) {
  return file("helmet", `{kind: helmet, mesh: ${inQuotes(name)}, units: ${units}, ribs: ${ribs}, clearance_mm: ${number(clearance_mm)}}`);
}

export function outline({points, name}) {
  return file("outline", `{kind: outline, points: ${points ? pairs(points) : inQuotes(name)}}`);
}
