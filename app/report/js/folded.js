// Large picture: the folded strip from the side, over the target curve.

/** Returns whether the side view x-z shows the shape. Other views are from above and at a slant. */
function seenFromSide(data) {
  return data.view === "side";
}

function sideView(data) {
  const toDrawing = frameOfDrawing(data.goal?.goal ?? [], data.goal?.drawn ?? []);
  return {place: toDrawing, project: (p) => toDrawing([p[0], p[2]]), depth: (p) => p[1]};
}

function slantView() {
  const c = Math.cos(Math.PI / 6), s = 0.5;
  return {
    place: (p) => p,
    project: (p) => [c * (p[0] - p[1]), s * (p[0] + p[1]) * 0.9 + p[2]],
    depth: (p) => p[0] + p[1] - p[2]
  };
}

function topView() {
  return {place: (p) => p, project: (p) => [p[0], p[1]], depth: (p) => -p[2]};
}

function viewOf(data) {
  if (seenFromSide(data)) return sideView(data);
  return data.view === "top" ? topView() : slantView();
}

/** Returns the visible plates. In side view the nearest two rows hide all rows behind them. */
function shownPlates(data, state) {
  const all = plates(data.structure), {firstRow} = data.structure;
  const shown = seenFromSide(data) ? all.filter((plate) => plate.hinge.row < firstRow + 2) : all;
  return shown.map((plate) => carriedPlate(data.structure, state, plate));
}

function wallShapes(data, state, view) {
  return shownPlates(data, state)
      .map(
          (plate) => ({plate, depth: view.depth(mean(plate.corners)), polygon: outline(plate, view.project)}))
      .sort((a, b) => b.depth - a.depth);
}

/** Returns the midline of the simulation, aligned with the model because its frame may have drifted. */
function physicsLine(data, modelLine) {
  if (!data.states.physics || data.verdict.verified === false) return [];
  const flat = (p) => [p[0], p[2]];
  const line = midline(data.structure, data.states.physics).map(flat);
  return line.length > 1 && line.length === modelLine.length ? line.map(planeMotion(line, modelLine).move) :
                                                               line;
}

function curveLines(data, view) {
  if (!seenFromSide(data)) return {model: [], physics: [], goal: []};
  const model = midline(data.structure, data.states.model).map((p) => [p[0], p[2]]);
  return {
    model: model.map(view.place),
    physics: physicsLine(data, model).map(view.place),
    goal: (data.goal?.goal ?? []).map(view.place),
  };
}

/** Returns a map with equal scales on both axes; `to` maps mm to px. */
function mapOf(points, width, margin) {
  const box = extent(points);
  const room = width - margin.left - margin.right;
  const perMm = Math.min(room / (box.size[0] || 1), Math.min(0.62 * width + 60, 560) / (box.size[1] || 1));
  const height = box.size[1] * perMm + margin.top + margin.bottom;
  const shift = margin.left + (room - box.size[0] * perMm) / 2;
  const to = ([x, z]) => [shift + (x - box.low[0]) * perMm, margin.top + (box.high[1] - z) * perMm];
  return {to, perMm, height, box};
}

function mmAxes(map, width, margin) {
  const {low, high} = map.box, floor = map.height - margin.bottom + 14;
  const most = (span) => Math.max(1, (span * map.perMm) / 70);
  const xs = linearTicks([low[0], high[0]], most(high[0] - low[0]));
  const zs = linearTicks([low[1], high[1]], most(high[1] - low[1]));
  const at = (x, z) => map.to([x, z]);
  return [
    svg("g", {class: "grid"},
        zs.map((t) => svg("path", {
                 d: path([[margin.left - 14, at(0, t.at)[1]], [width - margin.right, at(0, t.at)[1]]])
               })),
        xs.map((t) => svg("path", {d: path([[at(t.at, 0)[0], margin.top - 10], [at(t.at, 0)[0], floor]])}))),
    svg("g", {class: "ticks"},
        zs.map(
            (t) => svg("text", {x: margin.left - 20, y: at(0, t.at)[1] + 4, "text-anchor": "end"}, t.text)),
        xs.map((t) => svg("text", {x: at(t.at, 0)[0], y: floor + 16, "text-anchor": "middle"}, t.text))),
    svg("text", {class: "label", x: 2, y: 14}, "height z, mm"),
    svg("text", {class: "label", x: width - margin.right, y: map.height - 4, "text-anchor": "end"},
        "length x, mm"),
  ];
}

function drawFolded(data, width) {
  const view = viewOf(data);
  const margin = seenFromSide(data) ? {left: 62, right: 16, top: 40, bottom: 62} :
                                      {left: 16, right: 16, top: 16, bottom: 16};
  const walls = wallShapes(data, data.states.model, view), lines = curveLines(data, view);
  const map =
      mapOf([...walls.flatMap((wall) => wall.polygon), ...lines.goal, ...lines.physics], width, margin);
  const line = (name, width) => svg("path", {
    class: name,
    d: path(lines[name].map(map.to)),
    style: width ? `stroke-width:${width.toFixed(1)}` : null
  });
  const goalWidth = Math.max(3, Math.min(7, 0.4 * data.structure.height * map.perMm));
  return drawing(
      width, map.height,
      seenFromSide(data) ? "The folded strip seen from the side, over the target curve" : "The folded sheet",
      seenFromSide(data) ? mmAxes(map, width, margin) : null,
      svg("g", {class: "head"}, (data.goal?.backdrop ?? []).map((points) => svg("path", {d: path(points.map(view.project).map(map.to))}))),
      svg("g", {class: "bare"}, (data.goal?.bare ?? []).map((points) => svg("path", {d: path(points.map(view.project).map(map.to))}))),
      svg("g", {class: "walls"}, walls.map((wall) => svg("path", {d: path(wall.polygon.map(map.to), true)}))),
      line("goal", goalWidth), line("model"), line("physics"));
}

/** Returns the legend entry for parts of the goal without a rib nearby. */
function bareKey({goal}) {
  return goal?.bare?.length > 0 && ["bare", `bare, more than a cell edge from a rib: ${percent(1 - goal.covered)} of its area`];
}

function foldedPicture(data) {
  if (!data.states.model) return missing("This result holds no complete folded state to draw.");
  if (!data.structure.hinges.length) return missing("This result holds no structure to draw.");
  const hasGoal = seenFromSide(data) && data.goal?.goal?.length > 1;
  return html(
      "figure", {class: "picture"}, responsive((width) => drawFolded(data, width)),
      html(
          "figcaption", {},
          legend(
              hasGoal && ["goal", "target curve"], data.kind?.backdropKey, bareKey(data), ["wall", "walls, folded (model)"],
              seenFromSide(data) && ["model", "midline of the model"],
              seenFromSide(data) && data.states.physics && data.verdict.verified !== false && ["physics", "midline of the simulation"]),
          seenFromSide(data) ? "Seen from the side, true proportions. " +
                  "The midline runs through the middle of the strip\u2019s width and height." :
                               data.view === "top" ? "Seen from above, compressed." : "Seen at a slant from above."));
}
