/** Reads the candidates of a robust search: `robust` of result.json. */
function readRobustChoices(raw) {
  return list(raw).map((one, k) => ({...one, plain: k === 0})).filter((one) => finite(one?.as_made_rms_mm) !== null && finite(one?.designed_mm) !== null);
}

/** Returns the Pareto front: candidates that no other candidate beats in both errors. */
function robustFront(choices) {
  let least = Infinity;
  return [...choices].sort((a, b) => a.designed_mm - b.designed_mm).filter((one) => one.as_made_rms_mm < least && ((least = one.as_made_rms_mm), true));
}

function robustChoiceName(one) {
  return `fold angle ${degrees(toDegrees(one.theta_rad))}` + (finite(one.gap_mm) === null ? "" : `, gaps of ${millimetres(one.gap_mm)}`);
}

function drawRobustChoices(choices, width) {
  const near = choices.filter((one) => one.allowed);
  const axes = plot({
    width,
    label: "Error of the design and of its prints",
    x: {range: barRange(near.map((one) => one.designed_mm)), label: "error of the design, mm rms"},
    y: {range: barRange(near.map((one) => one.as_made_rms_mm)), label: "expected print error, mm rms"}
  });
  const at = (one) => [axes.X(one.designed_mm), axes.Y(one.as_made_rms_mm)];
  axes.root.append(svg("path", {class: "model", d: path(robustFront(near).map(at))}), ...near.map((one) => svg("circle", {
    cx: at(one)[0], cy: at(one)[1], r: one.chosen ? 6 : 3.5, class: one.chosen ? "tried chosen" : one.plain ? "tried plain" : "tried"
  }, svg("title", {}, robustChoiceName(one)))));
  return axes.root;
}

function robustChoiceSection({robustChoices}) {
  const chosen = robustChoices.find((one) => one.chosen), plain = robustChoices.find((one) => one.plain);
  const plainText = plain ? `${millimetres(plain.as_made_rms_mm)} for the original, with ${robustChoiceName(plain)}` :
                             "unknown for the original";
  return [
    html("p", {class: "lead"}, chosen && !chosen.plain ?
      `Expected print error: ${millimetres(chosen.as_made_rms_mm)} for this design, with ${robustChoiceName(chosen)}; ${plainText}.` :
      "None of the other designs that were tried is expected to print more accurately than the original."),
    responsive((width) => drawRobustChoices(robustChoices, width)),
    legend(["tried", "designs that meet the goal"], ["tried plain", "original"], ["tried chosen", "this one"]),
  ];
}
