// Surface: distance of a sheet's vertices from its two layers, and the largest plate height without collisions.

function readSurface(raw) {
  if (!raw || typeof raw !== "object") return null;
  const words = (texts) => list(texts).filter((text) => typeof text === "string");
  return {
    backdrop: list(raw.lines_mm).map((line) => numberRows(line, 3)).filter((line) => line.length > 1),
    bare: list(raw.bare_mm).map((line) => numberRows(line, 3)).filter((line) => line.length > 1),
    covered: finite(raw.covered_share), apart: {rms: finite(raw.goal_rms), max: finite(raw.goal_max)},
    facets: numberRows([raw.facets], 2)[0] ?? null, flat: numberRows(raw.flat_mm, 2), vertices: numberRows(raw.vertices_mm, 3),
    diagonal: finite(raw.diagonal_mm), layer: finite(raw.layer_mm),
    rms: finite(raw.rms), max: finite(raw.max), cover: finite(raw.cover),
    sector: numberRows([raw.sector_deg], 2)[0] ?? null, edge: numberRows([raw.edge], 2)[0] ?? null, beta: finite(raw.beta_deg),
    height: finite(raw.free_height), meets: raw.walls_meet === true, missing: finite(raw.curvature_missing),
    reasons: words(raw.reasons), physicsReasons: words(raw.reasons_physics), ribs: list(raw.ribs).length,
    ways: list(raw.ways).filter((way) => way && typeof way.way === "string").map((way) => ({
      name: way.way, rms: finite(way.rms), max: finite(way.max), pieces: finite(way.pieces), open: finite(way.open_area)})),
  };
}

function describeSurfaceResult(data) {
  const {goal: surface} = data;
  const off = surface.diagonal === null || surface.rms === null ? "" :
      `Its ${surface.ribs ? "bodies" : "vertices"} lie ${millimetres(surface.rms * surface.diagonal)} (${percent(surface.rms)} of the diagonal) off the surface.`;
  const near = surface.covered === null ? "" : ` ${percent(surface.covered)} of it are within a cell edge of a rib.`;
  return `${off}${near} ${describeSimulation(data)}`;
}

function surfaceNumbers(data) {
  const {goal: surface, tolerance, metrics} = data;
  if (surface.rms === null) return [];
  const shown = surface.diagonal === null ? percent(surface.rms) : millimetres(surface.rms * surface.diagonal);
  return [
    keyNumber(surface.ribs ? "Bodies from surface, rms" : "Vertices from surface, rms", shown, `${percent(surface.rms)} of the diagonal; allowed ${percent(tolerance.shape)}`),
    surface.covered !== null && keyNumber("Surface near a rib", percent(surface.covered), `of its area, within a cell edge; at least ${percent(tolerance.covered_share)}`),
    surface.covered === null && surface.cover !== null && keyNumber("Area shared", percent(surface.cover), `over the area of both; at least ${percent(tolerance.cover)}`),
    finite(metrics.curvature_share) !== null && keyNumber("Curvature", percent(metrics.curvature_share), `of the surface\u2019s own, both ways; at least ${percent(tolerance.curvature_share)} where it curves by more than 0.1 sr`),
    surface.height !== null && keyNumber("Plates may be", `${figures(surface.height, 2)} walls high`, "before walls collide during folding"),
  ];
}

// Draws the flat crease pattern.
function creasePattern({facets, flat}) {
  if (!facets || flat.length !== (facets[0] + 1) * (facets[1] + 1)) return null;
  const xs = flat.map(([x]) => x), ys = flat.map(([, y]) => -y);
  const left = Math.min(...xs), top = Math.min(...ys), width = Math.max(...xs) - left, height = Math.max(...ys) - top;
  const at = (i, j) => { const [x, y] = flat[j * (facets[0] + 1) + i]; return `${figures(x - left, 5)},${figures(-y - top, 5)}`; };
  const lines = [];
  for (let i = 0; i <= facets[0]; i++) lines.push(Array.from({length: facets[1] + 1}, (_, j) => at(i, j)).join(" "));
  for (let j = 0; j <= facets[1]; j++) lines.push(Array.from({length: facets[0] + 1}, (_, i) => at(i, j)).join(" "));
  return svg("svg", {viewBox: `${-0.01 * width} ${-0.01 * height} ${1.02 * width} ${1.02 * height}`, class: "creases", role: "img",
                     "aria-label": "crease pattern of the flat sheet"},
             ...lines.map((points) => svg("polyline", {points, fill: "none", stroke: "currentColor", "stroke-width": 0.004 * width})));
}

function surfaceSection({goal: surface, metrics}) {
  const rows = [];
  const row = (name, value) => value && rows.push({cells: [name, value]});
  const span = (range, digits, unit) => range && `${figures(range[0], digits)} to ${figures(range[1], digits)}${unit}`;
  row("facets", surface.facets && `${surface.facets[0]} \u00d7 ${surface.facets[1]}`);
  row("ribs", surface.ribs > 0 && String(surface.ribs));
  row(surface.ribs ? "bodies off the surface, rms" : "vertices off the surface, rms", surface.rms !== null && percent(surface.rms));
  row("the farthest", surface.max !== null && percent(surface.max));
  row("surface off the nearest rib, rms", surface.apart.rms !== null && percent(surface.apart.rms));
  row("the farthest place of the surface", surface.apart.max !== null && percent(surface.apart.max));
  row("cells on its area", surface.ribs > 0 && surface.cover !== null && percent(surface.cover));
  row("layers, apart", surface.layer !== null && millimetres(2 * Math.abs(surface.layer)));
  row("edges, over their mean", span(surface.edge, 2, ""));
  row("angles between creases", span(surface.sector, 3, "\u00b0"));
  row("largest tilt", surface.beta !== null && `${figures(surface.beta, 3)}\u00b0`);
  row("curvature missing", surface.missing !== null && percent(surface.missing));
  row("best cylinder or cone, off the surface, rms", finite(metrics.developable_rms) !== null && percent(metrics.developable_rms));
  const ways = surface.ways.map((way) => ({cells: [way.name, percent(way.rms), percent(way.max), String(way.pieces), percent(way.open)]}));
  const compared = ways.length > 1 &&
      table(["way", "off the surface, rms", "the farthest", "pieces", "open area"], ways,
            "The same surface in other ways: vertices of a sheet, bodies of ribs, in parts of the diagonal");
  if (surface.ribs) return [table(["what", "how much"], rows, "The ribs on their surface, in parts of the diagonal"), compared];
  return [
    table(["what", "how much"], rows, "The mesh on its surface, in parts of the diagonal"),
    compared,
    creasePattern(surface),
    html("p", {class: "note"}, "Every crease of this pattern folds at once, exactly: around each vertex opposite angles add up to 180\u00b0."),
  ];
}

const surfaceGoal = {
  name: "surface",
  read: (raw) => readSurface(raw.surface),
  view: "slant",
  backdropKey: ["head", "target surface"],
  describe: describeSurfaceResult,
  numbers: surfaceNumbers,
  firstSections: [["surface", "On its surface", surfaceSection]],
  lastSections: [],
};
