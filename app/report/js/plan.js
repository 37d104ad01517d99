// Plan and provenance: model, reasons, settings, times and origin of the result.

const FAMILIES = {
  F1: "F1, planar sheet: all hinges upright, moves within its plane",
  F2: "F2, cylindrical sheet: bends along one direction, one degree of freedom",
  F3: "F3, tilted rows: as F2, with the cross walls tilted too",
  F4: "F4, net of strips that share bodies",
  planar: "planar sheet: all hinges upright, every cell closes, each body follows its own path",
  creased: "creased sheet: planar panels, folded about lines that stay straight",
  none: "none: no analytic motion, joints have to separate",
};

const MODELS = {
  exact: "exact: analytic motion, no joint separates",
  equilibrium: "equilibrium: rigid walls and elastic hinges at rest",
  bullet: "rigid-body simulation (Bullet)",
};

/** Words for keys of `timing_s` that are not a verb. */
const TASKS = {
  balance: "trace the equilibrium path",
};

/** Converts a key to a title: "step_s" -> "Step, s". */
function title(key) {
  const text = words(key.replace(/_(s|mm|deg|rad|hz)$/, ", $1"));
  return text.charAt(0).toUpperCase() + text.slice(1);
}

function formatValue(value) {
  if (finite(value) !== null)
    return Math.abs(value) >= 1e-3 || value === 0 ?
        withSign(value, String(Number(Math.abs(value).toPrecision(6)))) :
        figures(value, 2);
  if (typeof value === "string") return words(value);
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (Array.isArray(value)) return value.map(formatValue).join(", ");
  return DASH;
}

function facts(entries) {
  const known =
      entries.filter(([, text]) => text !== null && text !== undefined && text !== "" && text !== DASH);
  if (!known.length) return null;
  return html(
      "dl", {class: "facts"},
      known.map(([name, text]) => html("div", {}, html("dt", {}, name), html("dd", {}, text))));
}

function group(title, ...content) {
  const shown = content.filter(Boolean);
  return shown.length ? html("section", {class: "group"}, html("h3", {}, title), shown) : null;
}

function describeMobility(mobility) {
  const m = dictionary(mobility);
  const part = (value, text) =>
      (finite(value) === null ? null : `${withSign(value, String(Math.abs(value)))} ${text}`);
  return [
    part(m.flat, "when flat"), part(m.moving, "while folding"), part(m.gruebler, "by counting (Gr\u00fcbler)")
  ].filter(Boolean)
      .join(", ");
}

function describeTheta(metrics) {
  const used = toDegrees(metrics.theta_rad), limit = toDegrees(metrics.theta_limit_rad);
  if (limit === null) return used === null ? null : `${degrees(used)} used`;
  return `0\u00b0 to ${degrees(limit)} before walls collide` +
      (used === null ? "" : `; ${degrees(used)} used`);
}

function planGroup(data) {
  const {plan, structure} = data;
  const why = list(plan.why).filter((line) => typeof line === "string");
  return group(
      "Plan", facts([
        ["Family", structure.isBodies ? null : FAMILIES[plan.family] ?? plan.family],
        ["Model", MODELS[plan.model] ?? plan.model],
        ["Bodies", finite(plan.bodies) ?? (structure.bodies.length || null)],
        ["Hinges", finite(plan.hinges) ?? (structure.hinges.length || null)],
        ["Degrees of freedom", describeMobility(plan.mobility)],
        ["Fold angle", describeTheta(data.metrics)],
      ].map(([name, value]) => [name, value === null || value === undefined ? null : String(value)])),
      why.length ? html("ul", {class: "why"}, why.map((line) => html("li", {}, line))) : null);
}

function stiffnessGroup({equilibrium, structure}) {
  if (!equilibrium) return null;
  const {k_point: point, k_turn: turn, reach_mm: reach, k_contact: contact} =
      structure.isBodies ? {k_contact: equilibrium.stiffness.k_contact} : equilibrium.stiffness;  // else per hinge
  return group("Hinges and walls", facts([
                 ["Joint stiffness per point", finite(point) === null ? null : `${neat(point)} N/mm`],
                 ["Rotation", finite(turn) === null ? null : `${neat(turn)} N mm/rad`],
                 ["Points at \u00b1", finite(reach) === null ? null : millimetres(reach)],
                 ["Walls in contact", finite(contact) === null ? null : `${neat(contact)} N/mm`],
               ]));
}

function searchGroup({optimiser}) {
  return group("Search", facts([
                 ["Solver", formatValue(optimiser.solver)],
                 ["Starts", formatValue(optimiser.starts)],
                 ["Evaluations", formatValue(optimiser.evaluations)],
                 ["Status", formatValue(optimiser.status)],
                 ["Because", formatValue(optimiser.why)],
               ]));
}

function physicsGroup({physics}) {
  const options =
      Object.entries(dictionary(physics.options)).map(([key, value]) => [title(key), formatValue(value)]);
  return group("Simulation", facts([
                 ["Status", formatValue(physics.status)],
                 ["Because", formatValue(physics.why)],
                 ["Steps", finite(physics.steps) === null ? null : String(physics.steps)],
                 ["Simulated time", duration(physics.simulated_s)],
                 ...options,
               ]));
}

function formatMetric(key, value) {
  if (key.endsWith("_rad"))
    return Math.abs(value) < 1e-4 ? `${figures(value, 2)} rad` : degrees(toDegrees(value));
  return figures(value, 3);
}

function metricsGroup({metrics}) {
  const known =
      Object.entries(metrics).filter(([, value]) => finite(value) !== null || typeof value === "boolean");
  return group(
      "All measures",
      facts(known.map(
          ([key, value]) =>
              [title(key.replace(/_rad$/, "")),
               typeof value === "boolean" ? formatValue(value) : formatMetric(key, value)])));
}

function originGroup({raw, timing}) {
  const times = Object.entries(timing)
                    .filter(([, value]) => finite(value) > 0)
                    .map(([key, value]) => ["Time to " + (TASKS[key] ?? words(key)), duration(value)]);
  return group("Origin", facts([
                 ["kinetix", formatValue(raw.kinetix_version)],
                 ["Seed", finite(raw.seed) === null ? null : String(raw.seed)],
                 ["Format", formatValue(raw.schema)],
                 ["Documentation", "share/doc/kinetix/html/index.html, or build/site/index.html after make site"],
                 ...times,
               ]));
}

function planSection(data) {
  const groups = [
    planGroup(data), stiffnessGroup(data), searchGroup(data), physicsGroup(data), originGroup(data),
    metricsGroup(data)
  ].filter(Boolean);
  return groups.length ? html("div", {class: "groups"}, groups) : missing("The plan was not recorded.");
}
