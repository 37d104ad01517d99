// The verdict in plain words, and the key numbers.

function describePhysics(data) {
  const {verify_rms: rms} = data.metrics, allowed = data.tolerance.verify;
  if (finite(rms) === null) {
    const why = typeof data.physics.why === "string" ? ` Reason: ${data.physics.why}` : "";
    return "The simulation gave no state to compare with." + why;
  }
  const size = `${millimetres(rms * data.structure.cell)} rms (${percent(rms)} of a cell edge)`;
  const limit = finite(allowed) === null ? "" : `; limit ${percent(allowed)}`;
  return `The simulated sheet settles ${size} away from the model${limit}.`;
}

/** Describes the simulation, or its absence. */
function describeSimulation(data) {
  return data.verdict.verified === null ? "It was not checked by a simulation." : describePhysics(data);
}

/** Describes a design, which has no target. */
function describeDesign(data) {
  const bodies = {true: "The bodies end where they are pulled to. ", false: "The bodies do not end where they are pulled to. "}[data.verdict.met] ?? "";
  return (bodies || "It has no target. ") + describeSimulation(data);
}

const TRADE_NAMES = {tango: "Tango", tpu95a: "TPU 95A", pp: "polypropylene"};

/** Describes the soft hinges that the print tolerance assumes, in one sentence; "" if there are none. */
function describeSoftHinges(taken) {
  if (!taken) return "";
  const what = `${TRADE_NAMES[taken.material] ?? taken.material} ${taken.kind === "film" ? "living hinges" : `${taken.kind}s`} ${millimetres(taken.gap_mm)} long (peak strain ${figures(taken.strain, 2)}, limit ${neat(taken.strain_allowed)})`;
  return taken.assumed ? ` You did not specify hinges, so kinetix assumed ${what}.` : ` Its hinges are ${what}.`;
}

const CONTACT_TEXT = " Printed walls may collide: the fold is beyond the collision-free range with print errors.";

const UNCHECKED_TEXT = " Collisions of printed walls were not checked.";

/** Describes collisions of printed walls during the motion, in one sentence; "" if none are expected. */
function describeContact({touching, mayTouch, isUnproven}) {
  if (touching > 0) return ` Walls touch during folding in ${percent(touching)} of simulated prints.`;
  return mayTouch ? CONTACT_TEXT : isUnproven ? UNCHECKED_TEXT : "";
}

/** Describes the print tolerance analysis; null without one. */
function describePrintTolerance({printTolerance}) {
  if (!printTolerance) return null;
  const source = printTolerance.sources[0], place = printTolerance.places[0];
  const there = place === undefined ? "" : ` Main error source: ${parameterNames[place.parameter] ?? place.parameter} in ${place.place} (${percent(place.share)} of the variance).`;
  const most = source === undefined ? "" : ` Main single source: ${parameterNames[source.parameter] ?? source.parameter} of hinge ` +
          `${source.hinge} (${percent(source.share)} of the variance).`;
  const designed = finite(printTolerance.designed) === null ? "" : ` The error of the design itself is ${millimetres(printTolerance.designed)} rms.`;
  return `Print tolerance (${printTolerance.process}): ${millimetres(printTolerance.rms)} rms expected, 95${SPACE}% of prints within ${millimetres(printTolerance.p95)}, ` +
      `limit ${millimetres(printTolerance.tolerance)}. These figures are estimates, not measurements.` + designed + there + most +
      (printTolerance.play ? ` Without the clearance of its pins: ${millimetres(printTolerance.play.rms_without_mm)} rms, 95${SPACE}% within ${millimetres(printTolerance.play.p95_without_mm)}.` : "") +
      describeSoftHinges(printTolerance.taken) + describeContact(printTolerance) + (printTolerance.confirmed ? "" : " The linear estimate is far from the simulated prints: " + describeSamplePrints(printTolerance.prints));
}

/** Describes the compensation for elastic hinges; null without one. */
function describeCompensation({matter}) {
  if (!matter) return null;
  if (matter.after === null) return `With elastic hinges it has no equilibrium: ${matter.why}.`;
  return `With elastic hinges, the ideal design would be ${millimetres(matter.before)} rms from the goal. This one is compensated: ` +
      `tilts changed by up to ${degrees(matter.change)}, ${millimetres(matter.after)} rms from the goal, limit ${millimetres(matter.tolerance)}.`;
}

function describeSamplePrints({count, failed, kept, rms_mm: rms, p95_mm: p95}) {
  if (count === 0) return `none of ${failed} simulated prints has an equilibrium near the design.`;
  const lost = failed > 0 ? `; ${failed} more have no equilibrium near the design` : "";
  return `${count} simulated prints: ${millimetres(rms)} rms from the goal, ${finite(kept) ?? `95${SPACE}%`} of them within ${millimetres(p95)}${lost}.`;
}

const parameterNames = {t: "position", alpha: "direction", beta: "tilt", offset: "offset"};

/** Returns the class of the verdict's colours: as on the console, red if a flag is false and amber if there are warnings. */
function toneOf({met, verified, printable, reaches, errors, warnings}) {
  if (errors.length || [met, verified, printable, reaches].includes(false)) return "bad";
  return warnings.length || !(met || verified) ? "unsure" : "good";
}

/** Returns the verdict: {mark, tone, title}. The title is that of the console, without the name of the design. */
function verdict({verdict: flags, name, title}) {
  const tone = toneOf(flags), mark = {bad: "\u2715", good: "\u2713", unsure: flags.warnings.length ? "!" : "i"}[tone];
  return {mark, tone, title: capital(title.startsWith(`${name}: `) ? title.slice(name.length + 2) : title)};
}

/** Describes the result in words. */
function describeResult(data) {
  return data.kind ? data.kind.describe(data) : data.equilibrium ? describeEquilibrium(data) : describeDesign(data);
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
      "Joint separation, largest", millimetres(fraction * data.structure.cell),
      `${figures(fraction, 2)} of a cell edge` + limitNote(data.tolerance, "stretch"));
}

function angleNumber(metrics) {
  if (finite(metrics.theta_rad) === null) return null;
  const limit = toDegrees(metrics.theta_limit_rad);
  return keyNumber(
      "Fold angle", degrees(toDegrees(metrics.theta_rad)),
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
            "Simulation against model", millimetres(verify * data.structure.cell),
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
    html("p", {}, describeResult(data)),
    data.matter ? html("p", {}, describeCompensation(data)) : null,
    data.printTolerance ? html("p", {}, describePrintTolerance(data)) : null,
    keyNumbers(data),
  ];
}
