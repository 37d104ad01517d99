// Stable states of a structure, and the energy barriers between them.

const MOST_PICTURES = 12;
const LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

/** Reads stable states with their letters, poses and numbers, and the barriers between pairs of them. */
function readStable(raw, structure) {
  const states = list(raw?.stable_states)
                     .map((state, k) => ({
                            letter: LETTERS[k] ?? String(k + 1),
                            energy: finite(state?.energy_Nmm),
                            drive: finite(state?.drive),
                            theta: finite(state?.theta_rad),
                            gap: finite(state?.hinge_gap_max),
                            how: typeof state?.how === "string" ? state.how : "",
                            shape: readState(state, structure)
                          }));
  const barriers = list(raw?.energy_barriers)
                       .map((barrier) => ({
                              between: list(barrier?.between).map((k) => states[k]).filter(Boolean),
                              energy: finite(barrier?.energy_Nmm),
                              drive: finite(barrier?.drive),
                              balanced: barrier?.balanced === true
                            }))
                       .filter((barrier) => barrier.between.length === 2 && barrier.energy !== null);
  const unresolved = list(raw?.unresolved_releases).filter((why) => typeof why === "string");
  return {states: states.filter((state) => state.energy !== null), barriers, unresolved};
}

/** Marks the stable states and barriers on the energy chart. */
function stableMarks(axes, {equilibrium, stable}) {
  if (stable.states.length < 2) return [];
  const at = ({drive, energy}) => [axes.X(driveShown(equilibrium, drive)), axes.Y(energy)];
  const inside = (mark) => mark.drive !== null && at(mark)[0] >= axes.area.left - 1 &&
      at(mark)[0] <= axes.area.right + 1;
  const state = (mark) => {
    const [x, y] = at(mark), corners = [[x, y - 6], [x + 6, y], [x, y + 6], [x - 6, y]];
    return svg(
        "g", {class: "stable"}, svg("title", {}, `stable state ${mark.letter}`),
        svg("path", {d: path(corners, true), fill: "currentColor"}),
        svg("text", {x: x + 9, y: y - 5}, mark.letter));
  };
  const barrier = (mark) => {
    const [x, y] = at(mark);
    return svg(
        "g", {class: "stable"}, svg("title", {}, "barrier"),
        svg("path", {d: path([[x - 9, y], [x + 9, y]])}),
        svg("text", {x, y: y - 6, "text-anchor": "middle"},
            `barrier ${mark.between.map(({letter}) => letter).join("\u2013")}`));
  };
  return [...stable.states.filter(inside).map(state), ...stable.barriers.filter(inside).map(barrier)];
}

/** Draws a state at the common scale of all states, at a slant. */
function drawStable(data, index, width) {
  const {structure, stable} = data, eye = camera(...VIEWS.Slant), parts = plates(structure);
  const shapes = stable.states.map(({shape}) => shape && centredFaces(structure, shape, parts, false));
  const height = Math.round(0.8 * width);
  const perMm = fittingScale(shapes.filter(Boolean).flat(), eye, width, height + 2 * SCALE_BAR_PX - 32);
  const to = (p) => [width / 2 + dot(p, eye.right) * perMm, height / 2 - dot(p, eye.up) * perMm];
  const lit = colour("model-plate"), shade = colour("model-shade");
  const depth = (face) => dot(mean(face), eye.away);
  const faces = shapes[index].sort((a, b) => depth(b) - depth(a));
  return drawing(
      width, height, `Stable state ${stable.states[index].letter}`,
      faces.map(
          (face) => svg("path", {
            d: path(face.map(to), true),
            fill: litColour(face, eye, lit, shade),
            stroke: shade,
            "stroke-width": 0.7
          })));
}

function stableFigure(data, state, index) {
  const {equilibrium} = data;
  const facts = [
    `energy ${force(state.energy, "N\u00a0mm")}`,
    state.theta === null ? null : `fold angle ${degrees(toDegrees(state.theta))}`,
    state.drive === null ? null : describeDrive(equilibrium, state.drive),
    state.gap === null ? null : `joint separation ${millimetres(state.gap * data.structure.cell)}`,
  ];
  return html(
      "div", {class: "part"}, html("h3", {}, index === 0 ? `${state.letter}: flat` : state.letter),
      state.shape ? responsive((width) => drawStable(data, index, width)) : missing("Its poses are missing."),
      html("p", {class: "note"}, facts.filter(Boolean).join(", "),
          ...(index > 0 ? [html("br"), state.how] : [])));
}

function describeBarrier({between: [from, to], energy, balanced}) {
  const climb = (state) => force(energy - state.energy, "N\u00a0mm");
  return `Between ${from.letter} and ${to.letter} the energy rises to ${force(energy, "N\u00a0mm")}: ${
             climb(from)} above ${from.letter}, ${climb(to)} above ${to.letter}` +
      (balanced ? "." : "; the structure jumped down from there.");
}

function stableSection(data) {
  const {states, barriers, unresolved} = data.stable;
  return [
    html(
        "p", {class: "lead"},
        "The structure stays in these states without a drive. The run released it at each minimum of the energy along the drive. There may be other states far from this motion."),
    html("div", {class: "heats"}, states.slice(0, MOST_PICTURES).map((state, k) => stableFigure(data, state, k))),
    states.length > MOST_PICTURES ?
        html("p", {class: "note"}, `${states.length - MOST_PICTURES} more are in the result file.`) :
        null,
    barriers.map((barrier) => html("p", {}, describeBarrier(barrier))),
    unresolved.length ? html("ul", {class: "why"}, unresolved.map((why) => html("li", {}, why))) : null,
  ].flat();
}
