// The verdict in plain words, and the key numbers.

function describePhysics(data) {
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

/** Returns the verdict on a design, which has no target. */
function designVerdict(data) {
  const {met, verified} = data.verdict;
  if (verified === false)
    return {mark: "!", tone: "bad", title: "The physics run " + failing(data), text: describePhysics(data)};
  const physics = verified ? ", and the physics run agrees" : "", text = verified ? describePhysics(data) : "";
  if (met) return {mark: "\u2713", tone: "good", title: "The bodies end where they are pulled to" + physics, text};
  if (met === false) return {mark: "\u2715", tone: "bad", title: "The bodies do not end where they are pulled to", text};
  return {
    mark: "i",
    tone: "unsure",
    title: verified ? "One folded state, and the physics run agrees" : "One folded state",
    text: verified && finite(data.metrics.verify_rms) !== null ? describePhysics(data) :
                                                                 "There was no target to judge it by."
  };
}

/** Describes the soft hinges with which prints are judged, in one sentence; "" if there are none. */
function describeSoftHinges(taken) {
  if (!taken) return "";
  return ` Its hinges are ${taken.assumed ? "assumed to be " : ""}${taken.kind}s of ${taken.material}, ${millimetres(taken.gap_mm)} long. They keep the ` +
      `turns of the design and are strained by ${figures(taken.strain, 2)} of ${neat(taken.strain_allowed)} that they bear.`;
}

const CONTACT_TEXT = " Walls of prints may meet on the way: its fold lies beyond what is proven free of contact with them out of place.";

const UNPROVEN_TEXT = " That walls of prints stay apart on the way is not proven.";

/** Describes collisions of printed walls during the motion, in one sentence; "" if none are expected. */
function describeContact({touching, mayTouch, isUnproven}) {
  if (touching > 0) return ` Walls touch on the way to the fold in ${percent(touching)} of simulated prints.`;
  return mayTouch ? CONTACT_TEXT : isUnproven ? UNPROVEN_TEXT : "";
}

/** Describes the print tolerance analysis; null without one. */
function describePrintTolerance({printTolerance}) {
  if (!printTolerance) return null;
  const source = printTolerance.sources[0], place = printTolerance.places[0];
  const there = place === undefined ? "" : ` The ${parameterPlurals[place.parameter] ?? place.parameter} of ${place.place} make ${percent(place.share)} of what errors do.`;
  const most = source === undefined ? "" : ` The largest single source is ${parameterNames[source.parameter] ?? source.parameter} of hinge ` +
          `${source.hinge} (${percent(source.share)} of what errors do).`;
  const designed = finite(printTolerance.designed) === null ? "" : `, ${millimetres(printTolerance.designed)} as designed`;
  return `Printed by ${printTolerance.process}, it ends up ${millimetres(printTolerance.rms)} from the goal (rms over points of the sheet and over ` +
      `prints${designed}); 95 of 100 prints stay within ${millimetres(printTolerance.p95)}, and ${millimetres(printTolerance.tolerance)} are allowed. These figures are estimates, not measurements.` + there + most +
      (printTolerance.play ? ` Without the play of its pins it would be ${millimetres(printTolerance.play.rms_without_mm)}, and ${millimetres(printTolerance.play.p95_without_mm)}.` : "") +
      describeSoftHinges(printTolerance.taken) + describeContact(printTolerance) + (printTolerance.confirmed ? "" : " That is to first order, and does not hold here: " + describeSamplePrints(printTolerance.prints));
}

/** Describes the compensation for elastic hinges; null without one. */
function describeCompensation({matter}) {
  if (!matter) return null;
  if (matter.after === null) return `With hinges as elastic as they are made it finds no equilibrium: ${matter.why}.`;
  return `With hinges as elastic as they are made, the exact design would end up ${millimetres(matter.before)} from the goal ` +
      `(rms). This one makes up for it, with tilts changed by up to ${degrees(matter.change)}, and ends up ` +
      `${millimetres(matter.after)} from it; ${millimetres(matter.tolerance)} are allowed.`;
}

function describeSamplePrints({count, failed, kept, rms_mm: rms, p95_mm: p95}) {
  if (count === 0) return `none of ${failed} prints in the elastic model found an equilibrium near the design.`;
  const lost = failed > 0 ? `, and ${failed} more found no equilibrium near the design` : "";
  return `${count} prints in the elastic model came out ${millimetres(rms)} off the goal, ${finite(kept) ?? "95 of 100"} of them within ${millimetres(p95)}${lost}.`;
}

const parameterPlurals = {t: "places", alpha: "directions", beta: "tilts", offset: "offsets"};
const parameterNames = {t: "the place", alpha: "the direction", beta: "the tilt", offset: "the offset"};

/** Makes the verdict red if any flag is false, and amber if there are warnings. */
function summarise(found, {verdict: {printable, reaches, warnings}}) {
  if (found.tone === "bad") return found;
  const fault = reaches === false ? "but its drive does not take it there" : printable === false ? "but it cannot be printed like this" : null;
  if (fault) return {...found, mark: "\u2715", tone: "bad", title: `${found.title}, ${fault}`};
  if (found.tone !== "good" || !warnings.length) return found;
  return {...found, mark: "!", tone: "unsure", title: `${found.title}, with ${count(warnings.length, "warning", "warnings")}`};
}

/** Returns the verdict: {mark, tone, title, text}. */
function verdict(data) {
  const found = data.kind ? data.kind.verdict(data) : data.equilibrium ? equilibriumVerdict(data) : designVerdict(data);
  return summarise(found, data);
}

function keyNumber(name, value, note) {
  return html(
      "div", {class: "number"}, html("dt", {}, name),
      html("dd", {}, html("strong", {}, value), html("span", {}, note)));
}

function limitNote(tolerance, key, word = "allowed") {
  return finite(tolerance[key]) === null ? "" : `; ${word} ${neat(tolerance[key])}`;
}

/** Makes key numbers from `metrics`. @param shown rows of [key, name, note, key of the tolerance, word "allowed"] */
function measures({metrics, tolerance}, shown) {
  return shown.filter(([key]) => finite(metrics[key]) !== null)
      .map(([key, name, note, ...limit]) => keyNumber(name, figures(metrics[key]), note + limitNote(tolerance, ...limit)));
}

function gapNumber(data, fraction) {
  if (finite(fraction) === null) return null;
  return keyNumber(
      "Hinge gap, largest", millimetres(fraction * data.structure.cell),
      `${figures(fraction, 2)} of a cell edge: how far hinges are pulled apart` + limitNote(data.tolerance, "stretch"));
}

function angleNumber(metrics) {
  if (finite(metrics.theta_rad) === null) return null;
  const limit = toDegrees(metrics.theta_limit_rad);
  return keyNumber(
      "Fold angle \u03b8", degrees(toDegrees(metrics.theta_rad)),
      "turn of each body from flat" + (limit === null ? "" : `; walls collide at ${degrees(limit)}`));
}

function timeNumber(data) {
  if (data.equilibrium && finite(data.timing.balance) !== null)
    return keyNumber(
        "Time to trace the path", duration(data.timing.balance),
        count(data.equilibrium.path.length - 1, "step", "steps"));
  const seconds = finite(data.timing.optimise);
  if (seconds === null || !data.raw.target) return null;
  const tries = finite(data.optimiser.evaluations);
  return keyNumber("Search time", duration(seconds), tries === null ? "" : `${tries} evaluations`);
}

function keyNumbers(data) {
  const {verify_rms: verify, hinge_gap_max: gap} = data.metrics;
  const numbers = [
    ...(data.kind?.numbers(data) ?? []),
    ...equilibriumNumbers(data),
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

/** Makes the section with the full verdict and all key numbers. */
function verdictSection(data) {
  return [
    html("p", {}, verdict(data).text),
    data.matter ? html("p", {}, describeCompensation(data)) : null,
    data.printTolerance ? html("p", {}, describePrintTolerance(data)) : null,
    keyNumbers(data),
  ];
}
