// Section 1: the verdict in plain words and the key numbers.

function lengthOf(data, fraction) {
  return finite(fraction) !== null && data.curve.scale !== null ? fraction * data.curve.scale : null;
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

function physicsWords(data) {
  const {verify_rms: rms} = data.metrics, allowed = data.tolerance.verify;
  if (finite(rms) === null) {
    const why = typeof data.physics.why === "string" ? ` It says: ${data.physics.why}` : "";
    return "The physics run gave no state to compare with." + why;
  }
  const size = `${millimetres(rms * data.structure.cell)} rms (${percent(rms)} of a cell edge)`;
  const limit = finite(allowed) === null ? "" : `; allowed is ${percent(allowed)}`;
  return `The same sheet in the physics engine settles ${size} away from the model${limit}.`;
}

function failing(data) {
  return data.physics.status && data.physics.status !== "settled" ? "failed" : "disagrees";
}

/** {mark, tone, title, text} */
function verdict(data) {
  if (data.display) return displayVerdict(data);
  if (data.fold) return foldVerdict(data);
  if (data.helmet) return helmetVerdict(data);
  if (data.balance && !data.raw.target) return balanceVerdict(data);
  const {met, verified} = data.verdict;
  const hasRun = data.states.physics !== null || finite(data.metrics.verify_rms) !== null ||
      Boolean(data.physics.status);
  if (met === false) {
    const also = verified === false ? " " + physicsWords(data) : "";
    const close = data.metrics.shape_rms <= data.tolerance.shape;
    const title = close ? "Shape reached, but walls collide on the way" : "Target missed";
    return {mark: "\u2715", tone: "bad", title, text: (close ? metWords(data) : missBy(data)) + also};
  }
  if (verified === false)
    return {
      mark: "!",
      tone: "bad",
      title: (met ? "Target met in the model, but the physics run " : "The physics run ") + failing(data),
      text: physicsWords(data)
    };
  if (met === null && !data.raw.target)
    return {
      mark: "i",
      tone: "unsure",
      title: verified ? "One folded state, and the physics run agrees" : "One folded state",
      text: verified && finite(data.metrics.verify_rms) !== null ? physicsWords(data) :
                                                                   "There was no target to judge it by."
    };
  if (met === null)
    return {
      mark: "?",
      tone: "unsure",
      title: "No verdict recorded",
      text: "This result does not say whether the target was met."
    };
  const title = verified ? "Target met, and the physics run agrees" : "Target met in the model";
  return {
    mark: "\u2713",
    tone: verified ? "good" : "unsure",
    title,
    text: metWords(data) + (hasRun ? " " + physicsWords(data) : " It was not checked by a physics run.")
  };
}

function metWords(data) {
  const rms = lengthOf(data, data.metrics.shape_rms), most = lengthOf(data, data.metrics.shape_max);
  if (rms === null) return "The folded shape is within the tolerance.";
  return `The folded strip lies ${millimetres(rms)} rms from the target curve` +
      (most === null ? "." : `, ${millimetres(most)} at worst.`);
}

function keyNumber(name, value, note) {
  return html(
      "div", {class: "number"}, html("dt", {}, name),
      html("dd", {}, html("strong", {}, value), html("span", {}, note)));
}

function ofDiagonal(data, fraction) {
  const size = data.curve.scale === null ? "the target\u2019s diagonal" :
                                           `the ${millimetres(data.curve.scale)} diagonal`;
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

const OTHER_NUMBERS = [
  ["contrast", "Contrast d\u2032", "letter cells against the rest, in standard deviations"],
  ["auc", "Letter recognised", "chance that a letter cell stands out from another (AUC); 0.5 is guessing"],
  ["distance_rms_mm", "Distance, rms", "mm, of the bodies from head plus clearance"],
  ["distance_max_mm", "Distance, largest", "mm, likewise"],
  ["face_rms", "Face error, rms", "corners of the faces against the ideal solid, in edges"],
];

/** Measures of targets that are no curves. */
function otherNumbers({metrics}) {
  return OTHER_NUMBERS.filter(([key]) => finite(metrics[key]) !== null)
      .map(([key, name, note]) => keyNumber(name, figures(metrics[key]), note));
}

function gapNumber(data, fraction) {
  if (finite(fraction) === null) return null;
  return keyNumber(
      "Hinge gap, largest", millimetres(fraction * data.structure.cell),
      `${figures(fraction, 2)} of a cell edge: how far hinges are pulled apart`);
}

function angleNumber(metrics) {
  if (finite(metrics.theta_rad) === null) return null;
  const limit = toDegrees(metrics.theta_limit_rad);
  return keyNumber(
      "Fold angle \u03b8", degrees(toDegrees(metrics.theta_rad)),
      "turn of each body from flat" + (limit === null ? "" : `; walls collide at ${degrees(limit)}`));
}

function timeNumber(data) {
  if (data.balance && finite(data.timing.balance) !== null)
    return keyNumber(
        "Time to follow the load", duration(data.timing.balance),
        count(data.balance.path.length - 1, "step", "steps"));
  const seconds = finite(data.timing.optimise);
  if (seconds === null || !data.raw.target) return null;
  const tries = finite(data.optimiser.evaluations);
  return keyNumber("Search time", duration(seconds), tries === null ? "" : `${tries} evaluations`);
}

function keyNumbers(data) {
  const {verify_rms: verify, hinge_gap_max: gap} = data.metrics;
  const numbers = [
    ...shapeNumbers(data),
    ...otherNumbers(data),
    ...balanceNumbers(data),
    finite(verify) !== null &&
        keyNumber(
            "Physics against model", millimetres(verify * data.structure.cell),
            `${figures(verify, 2)} cell edges rms` +
                (finite(data.tolerance.verify) === null ? "" : `; allowed ${neat(data.tolerance.verify)}`)),
    gapNumber(data, gap),
    angleNumber(data.metrics),
    timeNumber(data),
  ].filter(Boolean);
  return numbers.length ? html("dl", {class: "numbers"}, numbers) : null;
}

function reasons({curve, display, fold, helmet}) {
  const found = display ?? fold ?? helmet;
  return found ? [...found.reasons, ...found.physicsReasons] : curve.reasons;
}

function headline(data) {
  const {mark, tone, title, text} = verdict(data);
  return html(
      "header", {id: "headline"}, html("p", {class: "eyebrow"}, "KinetiX design report"),
      html("h1", {}, data.name),
      html(
          "div", {class: "verdict " + tone}, html("span", {class: "mark", "aria-hidden": "true"}, mark),
          html(
              "div", {}, html("h2", {}, title), html("p", {}, text),
              reasons(data).map((reason) => html("p", {class: "why"}, reason)))),
      keyNumbers(data), data.display ? null : foldedPicture(data));
}
