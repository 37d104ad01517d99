// Curve: the verdict, the distance along the curve, and needed against allowed turn.

function readCurve(raw, target) {
  const turn = list(raw.turn).filter((t) => finite(t?.column) !== null && finite(t?.needed_deg) !== null);
  return {
    folded: numberRows(raw.folded_mm, 2),
    goal: numberRows(raw.goal_mm, 2),
    drawn: numberRows(target.points_mm, 2),
    error: numberRows(raw.error, 2),
    scale: finite(raw.scale_mm),
    turn: turn.map((t) => ({column: t.column, needed: t.needed_deg, allowed: finite(t.allowed_deg)})),
    robust: list(raw.robust).map((one, k) => ({...one, plain: k === 0})).filter((one) => finite(one?.as_made_rms_mm) !== null && finite(one?.shape_rms) !== null),
    reasons: list(raw.reasons).filter((reason) => typeof reason === "string"),
  };
}

function lengthOf(data, fraction) {
  return finite(fraction) !== null && data.goal.scale !== null ? fraction * data.goal.scale : null;
}

function missBy(data) {
  const {shape_rms: rms} = data.metrics, allowed = data.tolerance.shape;
  if (finite(rms) === null) return "The best design does not reach the target.";
  const length = lengthOf(data, rms);
  const size = percent(rms) + " of its size" + (length === null ? "" : ` (${millimetres(length)})`);
  if (finite(allowed) === null || !(rms > allowed))
    return `The best design is off the target by ${size} rms.`;
  return `The best design is off the target by ${size} rms: ${figures(rms / allowed, 2)} times the allowed ${
      percent(allowed)}.`;
}

function describeDeviation(data) {
  const rms = lengthOf(data, data.metrics.shape_rms), most = lengthOf(data, data.metrics.shape_max);
  if (rms === null) return "The folded shape is within the tolerance.";
  return `The folded strip lies ${millimetres(rms)} rms from the target curve` +
      (most === null ? "." : `, ${millimetres(most)} at worst.`);
}

function describeCurveResult(data) {
  const isFar = data.verdict.met === false && !(data.metrics.shape_rms <= data.tolerance.shape);
  return `${isFar ? missBy(data) : describeDeviation(data)} ${describeSimulation(data)}`;
}

function ofDiagonal(data, fraction) {
  const size = data.goal.scale === null ? "the target\u2019s diagonal" :
                                           `the ${millimetres(data.goal.scale)} diagonal`;
  return `${percent(fraction)} of ${size}`;
}

function allowedNote(limit) {
  return finite(limit) === null ? "" : `; allowed ${percent(limit)}`;
}

function shapeNumbers(data) {
  const {shape_rms: rms, shape_max: most} = data.metrics;
  const shown = (fraction) =>
      (lengthOf(data, fraction) === null ? percent(fraction) : millimetres(lengthOf(data, fraction)));
  return [
    finite(rms) !== null &&
        keyNumber("Shape error, rms", shown(rms), ofDiagonal(data, rms) + allowedNote(data.tolerance.shape)),
    finite(most) !== null && keyNumber("Shape error, largest", shown(most), ofDiagonal(data, most)),
  ];
}

function worstError(error) {
  return error.reduce((worst, point) => (Math.abs(point[1]) > Math.abs(worst[1]) ? point : worst));
}

function errorRange(data) {
  const most = Math.abs(worstError(data.goal.error)[1]) || 1e-6;
  return [-1.35 * most, 1.35 * most];
}

/** Labels the chart with the rms and its limit, as text: a line would mislead, because points may exceed the rms. */
function rmsRemark(axes, data) {
  const rms = lengthOf(data, data.metrics.shape_rms), allowed = lengthOf(data, data.tolerance.shape), {right, top} = axes.area;
  if (rms === null) return [];
  const text = `rms ${millimetres(rms)}` + (allowed === null ? "" : `; allowed ${millimetres(allowed)}`);
  return [svg("text", {class: "remark", x: right, y: top - 3, "text-anchor": "end"}, text)];
}

function worstMark(axes, [arc, distance]) {
  const x = axes.X(arc), y = axes.Y(distance), toLeft = x > (axes.area.left + axes.area.right) / 2;
  return svg(
      "g", {class: "worst"}, svg("circle", {cx: x, cy: y, r: 4}),
      svg("text", {
        x: x + (toLeft ? -8 : 8),
        y: y + (distance > 0 ? -8 : 18),
        "text-anchor": toLeft ? "end" : "start"
      },
          `largest: ${millimetres(Math.abs(distance))}`));
}

function drawError(data, width) {
  const {error} = data.goal, range = errorRange(data);
  const axes = plot({
    width,
    label: "Distance from the target along the strip",
    x: {range: [0, error[error.length - 1][0] || 1], label: "length along the target, mm"},
    y: {range, label: "distance from the target, mm"}
  });
  const worst = worstError(error);
  axes.root.append(
      ...rmsRemark(axes, data),
      svg("path", {class: "goal-line", d: path([[axes.area.left, axes.Y(0)], [axes.area.right, axes.Y(0)]])}),
      svg("path", {class: "model", d: path(error.map(([arc, distance]) => [axes.X(arc), axes.Y(distance)]))}),
      worstMark(axes, worst));
  return axes.root;
}

function errorFigure(data) {
  if (data.goal.error.length < 2) return missing("The distance along the curve was not recorded.");
  return html(
      "div", {class: "part"}, html("h3", {}, "Distance from the target"), responsive((width) => drawError(data, width)),
      legend(["goal-line", "target (distance 0)"], ["model", "folded strip (model)"]),
      html("p", {class: "note"}, "The sign shows on which side of the target curve the strip runs."));
}

function isOver(turn) {
  return turn.allowed !== null && Math.abs(turn.needed) > turn.allowed * (1 + 1e-9);
}

/** Returns the sides to which some column turns: 1 up, -1 down. */
function sidesOf(turn) {
  return [1, -1].filter(
      (side) => turn.some((t) => side * t.needed > 0.05) ||
          (side > 0 && turn.every((t) => t.needed <= 0.05 && t.needed >= -0.05)));
}

function turnMarks(axes, turn, sides) {
  const half = 0.5 * (axes.X(1) - axes.X(0)), x = axes.X(turn.column);
  const limit = (side) => svg("path", {
    class: "turn-limit",
    d: path([[x - half, axes.Y(side * turn.allowed)], [x + half, axes.Y(side * turn.allowed)]])
  });
  return [
    bar(axes, turn.column, turn.needed, {class: "turn" + (isOver(turn) ? " over" : "")}),
    ...(turn.allowed === null ? [] : sides.map(limit))
  ];
}

/** Returns whether limits are drawn. Limits far above the bars appear only in the text, so the bars stay legible. */
function showsLimits(turn) {
  const needed = Math.max(...turn.map((t) => Math.abs(t.needed)));
  return turn.some((t) => t.allowed !== null && t.allowed < 4 * needed);
}

function drawTurns(data, width) {
  const {turn} = data.goal;
  const sides = showsLimits(turn) ? sidesOf(turn) : [],
        reach = turn.flatMap((t) => [t.needed, 0, ...sides.map((side) => side * (t.allowed ?? 0))]);
  const columns = {...span("Column", "columns", turn.map((t) => t.column))};
  const range = padded([Math.min(...reach), Math.max(...reach)]);
  const axes = plot({
    width,
    label: "Turn needed and allowed per column",
    x: columnAxis(columns, width),
    y: {range, label: "turn from column to column, degrees"}
  });
  axes.root.append(
      ...turn.flatMap((t) => turnMarks(axes, t, sides)),
      svg("path", {class: "zero", d: path([[axes.area.left, axes.Y(0)], [axes.area.right, axes.Y(0)]])}));
  return axes.root;
}

function describeTurn(turn) {
  const limited = turn.filter((t) => t.allowed > 0);
  if (!limited.length) return "";
  const use = (t) => Math.abs(t.needed) / t.allowed;
  const tightest = limited.reduce((a, b) => (use(b) > use(a) ? b : a));
  const over = limited.filter(isOver);
  const same = limited.length > 1 && limited.every((t) => use(t) > 0.99 * use(tightest));
  const most = (same ? "Every column needs the same share of what it may turn" :
                       `Column ${tightest.column} needs the largest share of what it may turn`) +
      `: ${degrees(Math.abs(tightest.needed))} of ${degrees(tightest.allowed)}`;
  return over.length ?
      `${over.length === 1 ? "One column needs" : over.length + " columns need"} more turn than allowed. ${
          most}.` :
      `${most} (${Math.round(100 * use(tightest))}${SPACE}%).`;
}

function turnFigure(data) {
  const {turn} = data.goal;
  if (!turn.length) return missing("The turn of each column was not recorded.");
  const over = turn.some(isOver);
  return html(
      "div", {class: "part"}, html("h3", {}, "Turn needed and turn allowed"),
      html("p", {class: "lead"}, describeTurn(turn)), responsive((width) => drawTurns(data, width)),
      legend(
          ["turn", "turn the target asks for"], over && ["turn over", "more than allowed"],
          showsLimits(turn) && ["turn-limit", "most that the tilt range allows"]));
}

/** Returns the Pareto front: strips that no other strip beats in both errors. */
function frontOf(tried) {
  const sorted = [...tried].sort((a, b) => a.shape_rms - b.shape_rms);
  let least = Infinity;
  return sorted.filter((one) => one.as_made_rms_mm < least && ((least = one.as_made_rms_mm), true));
}

function drawRobust(data, width) {
  const {robust, scale} = data.goal, off = (one) => one.shape_rms * scale;
  const near = robust.filter((one) => one.allowed || one.plain);
  const axes = plot({
    width,
    label: "Error of the design and of its prints",
    x: {range: padded([0, ...near.map(off)]), label: "error of the design, mm rms"},
    y: {range: padded([0, ...near.map((one) => one.as_made_rms_mm)]), label: "expected print error, mm rms"}
  });
  const dot = (one) => svg("circle", {
    cx: axes.X(off(one)), cy: axes.Y(one.as_made_rms_mm), r: one.chosen ? 6 : 3.5,
    class: one.chosen ? "tried chosen" : one.plain ? "tried plain" : "tried"
  }, svg("title", {}, `${one.columns} columns, fold angle ${degrees(toDegrees(one.theta_rad))}`));
  axes.root.append(svg("path", {class: "model", d: path(frontOf(near).map((one) => [axes.X(off(one)), axes.Y(one.as_made_rms_mm)]))}),
                   ...near.map(dot));
  return axes.root;
}

/** Draws the candidates of a robust search: error of the design against error of its prints. */
function robustFigure(data) {
  const {robust} = data.goal;
  if (!robust.length || data.goal.scale === null) return null;
  const chosen = robust.find((one) => one.chosen), plain = robust.find((one) => one.plain);
  const gaps = (one) => finite(one.gap_mm) === null ? "" : `, gaps of ${millimetres(one.gap_mm)}`;
  const named = (one) => `${one.columns} columns of ${millimetres(one.cell_mm)} at ${degrees(toDegrees(one.theta_rad))}${gaps(one)}`;
  return html(
      "div", {class: "part"}, html("h3", {}, "Designs and their prints"),
      html("p", {class: "lead"}, chosen && chosen !== plain ?
          `Expected print error: ${millimetres(chosen.as_made_rms_mm)} for this design (${named(chosen)}), ` +
              (plain ? `${millimetres(plain.as_made_rms_mm)} for the design with the smallest nominal error (${named(plain)}).` :
                       "unknown for the design with the smallest nominal error.") :
          "No other strip is expected to print more accurately than the one with the smallest nominal error."),
      responsive((width) => drawRobust(data, width)),
      legend(["tried", "strips that meet the goal"], ["tried plain", "smallest nominal error"], ["tried chosen", "this one"]));
}

function errorSection(data) {
  return [errorFigure(data), robustFigure(data), turnFigure(data)];
}

const curveGoal = {
  name: "curve",
  read: (raw) => readCurve(dictionary(raw.curve), dictionary(raw.target)),
  view: "side",
  describe: describeCurveResult,
  numbers: shapeNumbers,
  firstSections: [["folded", "Over the curve", foldedPicture]],
  lastSections: [
    ["errors", "Error along the curve", errorSection],
    ["tilts", "Tilts per column", tiltSection],
  ],
};
