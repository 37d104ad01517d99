// Dimension lines of a picture: the sizes of the box around the object, along three of its edges.

const GAP = 16, TICK = 5, ROOM = 5;  // CSS pixels: from the edge to its line; of a line's ends; from a line to its text
const SHORTEST = 36;                 // CSS pixels: shorter edges have no line
const INK = "#1b1f24", HALO = "#ffffff";

const middleOf = (a, b) => a.map((v, k) => 0.5 * (v + b[k]));

/** Returns the ends of the four edges along an axis, in pixels. */
function edgesAlong(axis, {low, high}, place) {
  const [u, v] = [0, 1, 2].filter((k) => k !== axis);
  return [[0, 0], [0, 1], [1, 0], [1, 1]].map(([a, b]) => {
    const from = [...low];
    from[u] = a ? high[u] : low[u];
    from[v] = b ? high[v] : low[v];
    return [place(from), place(Object.assign([...from], {[axis]: high[axis]}))];
  });
}

/** Returns the edge whose line is farthest outside: the lowest one along x and y, the leftmost one along z. */
function outerEdge(axis, box, place) {
  const rank = ([a, b]) => (axis === 2 ? -(a[0] + b[0]) : a[1] + b[1]);
  return edgesAlong(axis, box, place).reduce((best, edge) => (rank(edge) > rank(best) ? edge : best));
}

function stroke(context, lines) {
  for (const [width, colour] of [[4, HALO], [1.2, INK]]) {
    Object.assign(context, {lineWidth: width, strokeStyle: colour});
    context.beginPath();
    for (const [from, to] of lines) context.moveTo(...from), context.lineTo(...to);
    context.stroke();
  }
}

function write(context, text, [x, y], normal, {width, height}) {
  const half = 0.5 * context.measureText(text).width, tall = 7;
  const at = [x + normal[0] * (ROOM + half), y + normal[1] * (ROOM + tall)];
  const inside = (v, most, margin) => Math.max(margin, Math.min(most - margin, v));
  const place = [inside(at[0], width, half + 2), inside(at[1], height, tall + 2)];
  Object.assign(context, {lineWidth: 4, strokeStyle: HALO, fillStyle: INK});
  context.strokeText(text, ...place);
  context.fillText(text, ...place);
}

/** Draws the sizes of a box {low, high} in mm. @param context scaled to CSS pixels   @param place maps a point of the
 *  box to the picture   @param size {width, height} of the picture */
export function drawSizes(context, box, place, size) {
  const centre = place(middleOf(box.low, box.high));
  Object.assign(context, {font: '600 13px system-ui, "Liberation Sans", sans-serif', textAlign: "center", textBaseline: "middle", lineJoin: "round"});
  for (const axis of [0, 1, 2]) {
    const [from, to] = outerEdge(axis, box, place), along = to.map((v, k) => v - from[k]), length = Math.hypot(...along);
    if (length < SHORTEST) continue;
    const middle = middleOf(from, to), across = [along[1] / length, -along[0] / length];
    const side = across[0] * (middle[0] - centre[0]) + across[1] * (middle[1] - centre[1]) < 0 ? -1 : 1, normal = across.map((v) => side * v);
    const off = (point, by) => point.map((v, k) => v + by * normal[k]);
    const ends = [from, to].map((end) => [off(end, GAP - TICK), off(end, GAP + TICK)]);
    stroke(context, [...ends, [off(from, GAP), off(to, GAP)]]);
    write(context, `${Number((box.high[axis] - box.low[axis]).toPrecision(3))} mm`, off(middle, GAP), normal, size);
  }
}
