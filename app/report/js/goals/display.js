// Display: the panel before and after compression, its hinges, and the reading of every cell.

function readDisplay(raw) {
  if (!raw) return null;
  const reading = (part) => (part && typeof part === "object" ? {
    auc: finite(part.auc), contrast: finite(part.contrast), letter: finite(part.letter), rest: finite(part.rest),
    rank: finite(part.rank), cells: list(part.cells).map((value) => finite(value))
  } : null);
  const words = (texts) => list(texts).filter((text) => typeof text === "string");
  return {
    channel: typeof raw.channel === "string" ? raw.channel : "aperture",
    levels: list(raw.levels).map((level) => finite(level) ?? 0),
    before: reading(raw.before), after: reading(raw.after), physics: reading(raw.physics),
    stretch: finite(raw.stretch_max), starts: list(raw.starts), reasons: words(raw.reasons),
    physicsReasons: words(raw.reasons_physics), axis: raw.axis === "x" ? "x" : "y",
    compression: finite(raw.compression), angle: finite(raw.angle_rad),
    needed: list(raw.needed_cells).filter((side) => finite(side) !== null),
    loads: someDictionary(raw.loads), unlimited: someDictionary(raw.unlimited), printed: someDictionary(raw.printed),
    estimated: list(raw.estimated_cells).filter((side) => finite(side) !== null),
  };
}

function isGrey(display) {
  return display.levels.some((level) => level !== 0 && level !== 1);
}

function describeReading(display, reading) {
  if (isGrey(display)) return `rank correlation ${figures(reading.rank)} with the picture`;
  return `letter and background cells distinguished in ${percent(reading.auc)} of pairs, separation d\u2032 ${
      figures(reading.contrast, 3)}`;
}

function describeDisplay(data) {
  const {goal: display} = data;
  const model = `In the model: ${describeReading(display, display.after)}.`;
  return `${model} ${display.physics ? `In the simulation: ${describeReading(display, display.physics)}.` : describeSimulation(data)}`;
}

/** Counts the cells of a two-level picture that are on the correct side of the middle between letter and rest. */
function rightSide(display, reading) {
  if (!reading || isGrey(display) || reading.cells.length !== display.levels.length || reading.letter === null) return null;
  const middle = (reading.letter + reading.rest) / 2, up = reading.letter > reading.rest;
  const right = reading.cells.filter((value, k) => value !== null && (value > middle) === (up === (display.levels[k] === 1))).length;
  return {right, all: display.levels.length};
}

function describeRightSide(counted) {
  if (!counted) return null;
  const {right, all} = counted;
  return right === all ? `all ${all} cells on the right side` : `${right} of ${all} cells on the right side`;
}

/** Returns the outline of a cell: vertices and hinge points in turn. */
function cellOutline({structure, raw}, {bodies, hinges}, state) {
  return list(bodies).flatMap((body, k) => {
    const {rest} = structure.bodies[body], pose = state.poses[body];
    return [pose.p, carried(pose, rest, raw.structure.hinges[hinges[k]].point_mm)];
  });
}

function areaOf(points) {
  return Math.abs(0.5 * points.reduce((sum, [x, y], k) => {
    const [u, v] = points[(k + 1) % points.length];
    return sum + x * v - y * u;
  }, 0));
}

/** Returns [outline, luminance] of each lit cell. Luminance, 0 to 1, is the open area over that of the flat cell. */
function litCells(data, state) {
  const cells = list(data.raw.structure?.cells), outlines = cells.map((cell) => cellOutline(data, cell, state));
  return outlines.map((points, k) => [points, Math.min(1, areaOf(points) / (areaOf(cellOutline(data, cells[k], data.states.flat)) || 1))]);
}

const LIT_CELL = [255, 222, 115];  // sRGB of the lamp
const SRGB_GAMMA = 2.2;            // approximate exponent between luminance and pixel values

function cellColour(bright) {
  return `rgb(${LIT_CELL.map((full) => Math.round(full * bright ** (1 / SRGB_GAMMA))).join(",")})`;
}

/** Draws the panel in front of a lamp, from near. */
function litShot(data) {
  const cells = litCells(data, data.states.model), walls = plates(data.structure).map((plate) => carriedPlate(data.structure, data.states.model, plate));
  return {
    label: "The pressed panel before a lamp, in true luminance", points: cells.flatMap(([points]) => points),
    marks: (to) => [
      svg("g", {}, cells.map(([points, bright]) => svg("path", {d: path(points.map(to), true), style: `fill:${cellColour(bright)}`}))),
      svg("g", {class: "lit-walls"}, walls.map((plate) => svg("path", {d: path(topRim(plate).map(to), true)})))
    ]
  };
}

const ARC_MINUTE = 2.9e-4;                 // rad: resolution of an eye
const FARTHEST_M = 60, USUAL_CELLS = 0.5;  // end of the slider, m; initial blur in cells: hides walls but not strokes

/** Draws the panel from the distance on a slider: blurred by an arc minute, in true luminance unless enhanced. */
function distanceView(data) {
  const {goal: display, structure, states} = data, shown = [states.flat, states.model].filter(Boolean);
  const near = Math.min(FARTHEST_M, Math.round((USUAL_CELLS * structure.cell) / (1000 * ARC_MINUTE)));
  const {letter, rest} = display.after, middle = (letter + rest) / 2, spread = Math.abs(letter - rest);
  let view = null;
  const box = responsive((width) => {
    view = panelView(structure, shown, width);
    return drawing(view.width, view.height, "The pressed panel from a distance", svg("rect", {width: view.width, height: view.height, fill: "#fff"}),
                   panelFromAbove(structure, states.model, view, false));
  });
  box.classList.add("far");
  const words = html("output", {}), slider = html("input", {type: "range", min: 0, max: FARTHEST_M, step: 1, value: near, "aria-label": "Distance in metres"});
  const enhance = html("input", {type: "checkbox"}), blurs = svg("feGaussianBlur", {stdDeviation: 0});  // SVG blurs luminance, CSS values of pixels
  const look = () => {
    const metres = Number(slider.value), blur = 1000 * metres * ARC_MINUTE * (view?.scale ?? 1);
    blurs.setAttribute("stdDeviation", blur.toFixed(2));
    box.style.filter = "url(#far-blur)" + (enhance.checked && spread > 0 ? ` brightness(${(0.5 / middle).toFixed(3)}) contrast(${Math.min(12, 0.5 / spread).toFixed(2)})` : "");
    words.textContent = `${metres} m`;
  };
  for (const control of [slider, enhance]) control.addEventListener("input", look);
  requestAnimationFrame(() => requestAnimationFrame(look));
  return html(
      "figure", {class: "shot", id: "distance"}, html("div", {class: "far-frame"}, box),
      svg("svg", {width: 0, height: 0}, svg("filter", {id: "far-blur", x: "-20%", y: "-20%", width: "140%", height: "140%"}, blurs)),
      html("div", {class: "controls"}, html("label", {class: "slider"}, "from", slider, words), html("label", {}, enhance, " enhance contrast")),
      html("figcaption", {}, html("strong", {}, "From a distance:"), " walls blur by an arc minute, in true luminance unless enhanced"));
}

/** Draws a panel from above, at the scale of `view`. */
function panelFromAbove(structure, state, view, pale) {
  const to = ([x, y]) => [(x - view.low[0]) * view.scale, (view.high[1] - y) * view.scale];
  const d = structure.hinges.flatMap(
      (hinge) => [hinge.a, hinge.b].map(
          (body) => path([to(state.poses[body].p), to(carried(state.poses[body], structure.bodies[body].rest, wallTip(structure, hinge)))])));
  return svg("path", {
    d: d.join(""), fill: "none", stroke: pale ? "#c8c8c8" : "#111", "stroke-linecap": "round",
    "stroke-width": Math.max(0.6, structure.thickness * view.scale).toFixed(2)
  });
}

function panelView(structure, states, width) {
  const box = extent(states.flatMap((state) => state.poses.map(({p}) => p)));
  const low = box.low.map((x) => x - structure.cell / 2), high = box.high.map((x) => x + structure.cell / 2);
  const scale = width / (high[0] - low[0]);
  return {low, high, scale, width, height: (high[1] - low[1]) * scale};
}

function hingeDots(structure, view) {
  return structure.hinges.map((hinge) => {
    const off = Math.max(-1, Math.min(1, (hinge.t - 0.5) / 0.42)), strong = Math.abs(off);
    const shade = (on) => Math.round(255 * (0.55 * (1 - strong) + (on ? 0.85 * strong : 0)));
    return svg("circle", {
      cx: (hinge.point[0] - view.low[0]) * view.scale, cy: (view.high[1] - hinge.point[1]) * view.scale,
      r: 0.09 * structure.cell * view.scale,
      fill: `rgb(${shade(off > 0)},${shade(false)},${shade(off < 0)})`
    }, svg("title", {}, `t = ${figures(hinge.t)}`));
  });
}

function pictureBox(label, note, draw) {
  return html("figure", {class: "shot"}, responsive(draw), html("figcaption", {}, html("strong", {}, `${label}:`), " ", note));
}

/** Makes the program's pictures of the panel from a distance. */
function farViews(data) {
  const pictures = dictionary(data.raw.pictures);
  const view = (name, label, note) => typeof pictures[name] === "string" && html(
      "figure", {class: "shot"}, html("img", {src: pictures[name], alt: label}),
      html("figcaption", {}, html("strong", {}, `${label}:`), " ", note));
  return [
    view("afar_before.png", "Before, from a distance", "the light of a lamp through the flat panel, in true luminance: the lamp itself would be white"),
    view("afar_after.png", "After, from a distance", "the light through the compressed panel, in true luminance"),
    view("afar_before_enhanced.png", "Before, enhanced", "the same with its contrast stretched"),
    view("afar_after_enhanced.png", "After, enhanced", "the same with its contrast stretched, as an eye that has adapted may see it"),
  ].filter(Boolean);
}

function displaySection(data) {
  const {structure, states, goal: display} = data;
  const shown = [states.flat, states.model, states.physics].filter(Boolean);
  const shot = (state, label, note, hinges = false) => state && pictureBox(label, note, (width) => {
    const view = panelView(structure, shown, width);
    return drawing(view.width, view.height, label, svg("rect", {width: view.width, height: view.height, fill: "#fff"}),
                   panelFromAbove(structure, state, view, hinges), hinges ? hingeDots(structure, view) : []);
  });
  return html(
      "div", {}, html("div", {class: "shots"},
                      shot(states.flat, "Before", display.before ? describeReading(display, display.before) : ""),
                      shot(states.model, "After compression", describeRightSide(rightSide(display, display.after)) ?? describeReading(display, display.after)),
                      farViews(data), states.model && display.after?.letter !== null ? distanceView(data) : null,
                      shot(states.physics, "After, in the simulation",
                           display.physics ? describeReading(display, display.physics) : "not settled"),
                      shot(states.flat, "Where the hinges are",
                           "grey: in the middle of the wall; blue: towards its lower or left end; red: towards the other",
                           true)),
      html("p", {}, (display.angle === null ?
                         `Compressed along ${display.axis} by ${percent(display.compression)}.` :
                         `Moved by one hinge, turned by ${figures(Math.abs(display.angle) * 180 / Math.PI, 3)} degrees; no plates hold its rows.`) +
                        (finite(display.stretch) === null ? "" : ` Largest joint separation: ${millimetres(display.stretch * structure.cell)}.`)),
      limitsTable(display), printsTable(display), neededPanel(display), startsTable(display));
}

/** Makes the table of loads and contrast with and without limits of force and strain. */
function limitsTable(display) {
  if (!display.loads) return null;
  const row = (name, loads) => ({cells: [
    name, finite(loads.compression) === null ? "one hinge" : percent(loads.compression), `${figures(loads.force_N, 2)} N`, figures(loads.strain, 2), figures(loads.auc, 3), figures(loads.contrast, 2)
  ]});
  const rows = [row(display.unlimited ? "within the limits" : "this panel, within the limits", display.loads)];
  if (display.unlimited) rows.push(row("without limits", display.unlimited));
  return html("div", {class: "scroll"},
              table(["", "compressed by", "force, largest", "strain, largest", "AUC", "separation d\u2032"], rows, "Limits of force and strain"));
}

/** Makes the table of the print tolerance analysis. */
function printsTable(display) {
  if (!display.printed) return null;
  const {expected, prints} = display.printed;
  const row = (name, made) => ({cells: [name, figures(made?.contrast, 2), figures(made?.contrast_p05 ?? made?.contrast_p95, 2), figures(made?.auc, 3)]});
  return html("div", {class: "scroll"},
              table(["prints", "separation d\u2032, mean", "separation d\u2032 that 95 % of prints exceed", "AUC"],
                    [row("expected", expected), row(`${display.printed.count} simulated in the elastic model`, prints)],
                    display.printed.confirmed === false ? "Pictures of prints, estimated. The linear estimate is far from the simulated prints" : "Pictures of prints, estimated"));
}

/** Describes the size of a panel that is needed or estimated. The reasons are at the top of the page. */
function neededPanel(display) {
  const panel = ([columns, rows], words) => html("p", {}, html("strong", {}, `${columns} \u00d7 ${rows} cells`), words);
  if (display.needed.length === 2) return panel(display.needed, " is the smallest panel that keeps all strokes of the picture.");
  if (display.estimated.length === 2) return panel(display.estimated, " is an estimate of the panel that shows it clearly enough. No search confirmed it.");
  return null;
}

function startsTable(display) {
  const rows = display.starts.filter((start) => start && typeof start.name === "string");
  if (rows.length === 0) return null;
  return html("div", {},
              html("p", {}, "The search starts from the paper\u2019s rule (uniform-scaling cells where the picture is) by both " +
                                "checkerboards, and from variations of it. Separation before the search:"),
              table(["start", "AUC", "separation d\u2032", "cost after the first stage", ""],
                    rows.map((start) => ({cells: [
                      start.name, figures(start.auc), figures(start.contrast), figures(start.cost),
                      start.sharpened === true ? "sharpened" : ""
                    ]})),
                    "Starts of the search"));
}

const AT_LEAST = "required at least";
const GREY_NUMBERS = [
  ["rank", "Rank correlation", "of the cells with the levels of the picture; 1 is the same order", "auc", AT_LEAST],
];
const LETTER_NUMBERS = [
  ["contrast", "Separation d\u2032", "letter cells against the rest, in standard deviations", "contrast", AT_LEAST],
  ["auc", "Letter recognised", "probability of the correct order of a letter cell and another (AUC); 0.5 is chance", "auc", AT_LEAST],
];

function displayNumbers(data) {
  return measures(data, isGrey(data.goal) ? GREY_NUMBERS : LETTER_NUMBERS);
}

const displayGoal = {
  name: "display",
  read: (raw) => raw.display && {...readDisplay(raw.display), under: list(dictionary(raw.target).rows).filter((row) => typeof row === "string")},
  view: "top",
  describe: describeDisplay,
  numbers: displayNumbers,
  standing: litShot,
  firstSections: [["display", "What the panel shows", displaySection]],
};
