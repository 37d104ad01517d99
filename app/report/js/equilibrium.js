// Equilibrium of elastic hinges: load and energy along the drive, and the distribution of energy in the sheet.

const EVENT_NAMES = {
  bifurcation: "buckles",
  snap: "snaps",
  contact: "walls touch",
  release: "walls part",
  lock: "walls lock",
  slack: "the tendon goes slack",
  departure: "leaves the analytic motion",
};

/** Names an event. A limit point is a maximum or a minimum of the load, depending on its sentence. */
function eventName({kind, what}) {
  if (kind === "limit point") return /minimum/.test(what) ? "load is least" : "load peaks";
  return EVENT_NAMES[kind] ?? words(kind);
}

const STOPS = {
  reached: "reached its goal",
  torn: "stopped: a joint separated",
  locked: "stopped: walls in contact jam it",
  "not converged": "stopped: no equilibrium found further on",
  "interrupted": "stopped: on request",
};

function readEnergies(raw) {
  return list(raw).map((e) => ({stretch: finite(e?.stretch), turn: finite(e?.turn)}));
}

/** Texts for each kind of drive: action, load, axis label, coordinate in words; `shown` converts to the axis' unit. */
const DRIVES = {
  plates: {
    holds: "The plates press with",
    load: "force on the plates",
    axis: "compression of the plates, %",
    words: (drive) => `${percent(drive)} compression`,
    shown: (drive) => 100 * drive,
  },
  hinge: {
    holds: "The driven hinge holds",
    load: "moment of the drive",
    axis: "rotation of the driven hinge, degrees",
    words: (drive) => `${degrees(toDegrees(drive))} rotation`,
    shown: toDegrees,
  },
  cord: {
    holds: "The tendon pulls with",
    load: "tension of the tendon",
    axis: "shortening of the tendon, mm",
    words: (drive) => `${figures(drive)}${SPACE}mm shorter tendon`,
    shown: (drive) => drive,
  },
  springs: {
    holds: "The hot springs hold together",
    load: "moments of all springs",
    axis: "angle at which the springs rest, degrees",
    words: (drive) => `${degrees(toDegrees(drive))} rest angle`,
    shown: toDegrees,
  },
};

function driveKind(unit, springs) {
  if (springs) return DRIVES.springs;
  return unit === "rad" ? DRIVES.hinge : unit === "mm" ? DRIVES.cord : DRIVES.plates;
}

function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** Reads the section `equilibrium`; null without a path. */
function readEquilibrium(raw) {
  const path = list(raw?.path).filter((step) => finite(step?.drive) !== null && finite(step.load) !== null);
  if (!path.length) return null;
  const events =
      list(raw.events).filter((event) => finite(event?.drive) !== null && finite(event.load) !== null);
  return {
    path,
    events,
    stop: raw.stop,
    why: typeof raw.why === "string" ? raw.why : "",
    planar: raw.planar === true,
    drive: driveKind(path[0].drive_unit, raw.shape_memory),
    unit: path[0].load_unit === "N mm" ? "N\u00a0mm" : "N",
    last: path[path.length - 1],
    goal: finite(raw.goal_rad),
    isOnTheOtherSide: raw.other_side === true,
    stiffness: dictionary(raw.stiffness),
    energies: readEnergies(raw.hinge_energy_Nmm),
    springs: finite(raw.shape_memory?.energy_Nmm) ?? 0,
  };
}

function force(value, unit) {
  return `${figures(value)}${SPACE}${unit}`;
}

function describeDrive(equilibrium, drive) {
  return equilibrium.drive.words(drive);
}

/** Converts the drive's coordinate to the unit of its axis: percent, mm or degrees. */
function driveShown(equilibrium, drive) {
  return equilibrium.drive.shown(drive);
}

/** Describes how the drive ended, its load and its energy. */
function describeEquilibrium(data) {
  const {equilibrium} = data, load = force(equilibrium.last.load, equilibrium.unit);
  const held = `${equilibrium.drive.holds} ${load} at ${
      describeDrive(equilibrium, equilibrium.last.drive)}; the hinges store ${
      force(equilibrium.last.energy_Nmm, "N\u00a0mm")}.`;
  if (equilibrium.stop !== "reached")
    return `The drive ${STOPS[equilibrium.stop] ?? words(equilibrium.stop)}. ${held} Reason: ${equilibrium.why}`;
  const side = !equilibrium.isOnTheOtherSide ? "" :
      `It folded in the opposite direction: its fold angle is ${degrees(toDegrees(data.metrics.theta_rad))}, requested ${degrees(toDegrees(equilibrium.goal))}. `;
  return `${side}${held} ${describeSimulation(data)}`;
}

function equilibriumNumbers(data) {
  const {equilibrium, metrics} = data;
  if (!equilibrium) return [];
  const sum = (part) => equilibrium.energies.reduce((total, e) => total + (e[part] ?? 0), 0);
  const stretch = sum("stretch"), turn = sum("turn"), 
        rest = equilibrium.last.energy_Nmm - stretch - turn - equilibrium.springs;
  const shares =
      [[stretch, "stretch"], [turn, "rotation"], [equilibrium.springs, "the drive\u2019s springs"], [rest, "walls pressed together"]]
          .map(([value, name]) => [Math.round(100 * value / equilibrium.last.energy_Nmm), name])
          .filter(([share]) => share > 0)
          .map(([share, name]) => `${share}${SPACE}% ${name}`);
  return [
    keyNumber(
        capital(equilibrium.drive.load), force(equilibrium.last.load, equilibrium.unit),
        `at ${describeDrive(equilibrium, equilibrium.last.drive)}`),
    keyNumber("Energy", force(equilibrium.last.energy_Nmm, "N\u00a0mm"), shares.join(", ")),
    finite(metrics.exact_rms) !== null &&
        keyNumber(
            "From the analytic motion", millimetres(metrics.exact_rms * data.structure.cell),
            `${figures(metrics.exact_rms, 2)} cell edges rms from the analytic motion of the same drive`),
  ];
}

/** Makes numbered marks at the events. They are moved apart, and have names if there is room. */
function eventMarks(axes, events, at) {
  const placed = [];
  const mark = (event, k) => {
    const [x, y] = at(event), r = 8;
    let top = y - 16;
    const clashes = () => placed.some(([px, py]) => Math.hypot(px - x, py - top) < 2 * r + 1);
    while (clashes() && top > axes.area.top) top -= 5;
    if (top < axes.area.top - 12) top = y + 18;
    while (clashes() && top < axes.area.bottom) top += 5;
    placed.push([x, top]);
    const room = (dx) => x + dx > axes.area.left && x + dx < axes.area.right &&
        events.every(
            (other) => other === event || Math.abs(at(other)[0] - x - dx / 2) > Math.abs(dx / 2) + r);
    const side = room(-80) ? -1 : room(80) ? 1 : 0;
    const name = eventName(event);
    return svg(
        "g", {class: "event"}, svg("title", {}, event.what), svg("path", {d: path([[x, y], [x, top]])}),
        svg("circle", {class: "spot", cx: x, cy: y, r: 2.5}),
        svg("circle", {class: "badge", cx: x, cy: top, r}),
        svg("text", {x, y: top + 4, "text-anchor": "middle"}, String(k + 1)),
        side ? svg("text",
                   {class: "name", x: x + side * 12, y: top + 4, "text-anchor": side > 0 ? "start" : "end"},
                   name) :
               null);
  };
  return events.map(mark);
}

function alongDrive(data, width, key, label, name) {
  const {equilibrium} = data, values = equilibrium.path.map((step) => finite(step[key]) ?? 0);
  const drives = equilibrium.path.map((step) => driveShown(equilibrium, step.drive));
  const top = Math.max(0, ...values), bottom = Math.min(0, ...values);
  const axes = plot({
    width,
    height: 300,
    label: name,
    x: {
      range: [Math.min(0, ...drives), Math.max(...drives, 1e-9)],
      label: equilibrium.drive.axis
    },
    y: {range: [bottom - (bottom < 0 ? 0.06 : 0) * (top - bottom), top + 0.14 * (top - bottom || 1)], label},
    left: 66
  });
  const points = equilibrium.path.map((step, k) => [axes.X(drives[k]), axes.Y(values[k])]);
  const loose =
      equilibrium.path.map((step, k) => (step.stable === false && k > 0 ? points[k] : null)).filter(Boolean);
  axes.root.append(
      svg("path", {class: "zero", d: path([[axes.area.left, axes.Y(0)], [axes.area.right, axes.Y(0)]])}),
      svg("path", {class: "model", d: path(points)}),
      ...points.map(([cx, cy]) => svg("circle", {class: "step", cx, cy, r: 2})),
      ...loose.map(([cx, cy]) => svg("circle", {class: "loose", cx, cy, r: 4})));
  return {axes, at: (event, value) => [axes.X(driveShown(equilibrium, event.drive)), axes.Y(value)]};
}

function drawLoad(data, width) {
  const {axes, at} = alongDrive(
      data, width, "load", `${data.equilibrium.drive.load}, ${data.equilibrium.unit}`, "Load along the drive");
  axes.root.append(...eventMarks(axes, data.equilibrium.events, (event) => at(event, event.load)));
  return axes.root;
}

function energyAt({path: steps}, event) {
  return (steps.find((step) => step.theta_rad === event.theta_rad) ?? steps[0]).energy_Nmm;
}

function drawEnergy(data, width) {
  const {axes, at} = alongDrive(
      data, width, "energy_Nmm", "energy of hinges and contacts, N\u00a0mm", "Energy along the drive");
  axes.root.append(
      ...eventMarks(axes, data.equilibrium.events, (event) => at(event, energyAt(data.equilibrium, event))),
      ...stableMarks(axes, data));
  return axes.root;
}

function eventTable({equilibrium}) {
  if (!equilibrium.events.length)
    return html("p", {class: "note"}, "No events: one smooth branch.");
  const row = (event, k) => ({
    cells: [
      String(k + 1), eventName(event), describeDrive(equilibrium, event.drive),
      degrees(toDegrees(event.theta_rad)), force(event.load, equilibrium.unit), event.what ?? ""
    ]
  });
  return html(
      "div", {class: "scroll"},
      table(
          ["", "event", "at", "fold angle", "load", "what happened"], equilibrium.events.map(row),
          "Events along the drive"));
}

function loadSection(data) {
  const {equilibrium} = data;
  if (equilibrium.path.length < 2) return missing("The sheet stays flat: there is no path to show.");
  return [
    html(
        "p", {class: "lead"},
        `From flat to ${describeDrive(equilibrium, equilibrium.last.drive)} in ${
            count(equilibrium.path.length - 1, "step", "steps")}, ` +
            `each an equilibrium (dots). Numbers mark the events in the table.`),
    responsive((width) => drawLoad(data, width)),
    responsive((width) => drawEnergy(data, width)),
    equilibrium.path.slice(1).some((step) => step.stable === false) ?
        legend(["loose-key", "not stable: a small push would move it away"]) :
        null,
    eventTable(data),
  ];
}

function heatColour(share) {
  const s = Math.max(0, Math.min(1, share));
  return s < 0.5 ? blend(colour("heat-none"), colour("heat-some"), 2 * s) :
                   blend(colour("heat-some"), colour("heat-most"), 2 * s - 1);
}

function drawHeat(data, part, width) {
  const {structure, equilibrium} = data;
  const values = equilibrium.energies.map((e) => e[part] ?? 0), most = Math.max(...values, 0);
  const line =
      structure.hinges.map((hinge) => [structure.bodies[hinge.a].rest, structure.bodies[hinge.b].rest]);
  const margin = {left: 14, right: 14, top: 14, bottom: 64};
  const map = mapOf(line.flat(), width, margin);
  const r = Math.max(2.5, Math.min(11, 0.2 * structure.cell * map.perMm));
  const dot = (hinge, k) => {
    const [cx, cy] = map.to(hinge.point);
    return svg(
        "circle", {class: "heat", cx, cy, r, fill: heatColour(most > 0 ? values[k] / most : 0)},
        svg("title", {},
            `${nameWall(hinge)}: ${figures(values[k])} N mm`));
  };
  const bar = Math.min(200, width - 120), x0 = (width - bar) / 2, y0 = map.height - 34, steps = 30;
  return drawing(
      width, map.height, `Energy in ${part} of each hinge`,
      svg("g", {class: "plan"}, line.map(([a, b]) => svg("path", {d: path([map.to(a), map.to(b)])}))),
      structure.hinges.map(dot), Array.from({length: steps}, (_, k) => svg("rect", {
                                                               x: x0 + (k * bar) / steps,
                                                               y: y0,
                                                               width: bar / steps + 0.6,
                                                               height: 10,
                                                               fill: heatColour(k / (steps - 1))
                                                             })),
      svg("g", {class: "ticks"}, svg("text", {x: x0, y: y0 + 26, "text-anchor": "middle"}, "0"),
          svg("text", {x: x0 + bar, y: y0 + 26, "text-anchor": "middle"}, force(most, "N\u00a0mm"))));
}

function heatFigure(data, part, title, note) {
  const sum = data.equilibrium.energies.reduce((total, e) => total + (e[part] ?? 0), 0);
  return html(
      "div", {class: "part"}, html("h3", {}, `${title}: ${force(sum, "N\u00a0mm")} in all`),
      responsive((width) => drawHeat(data, part, width)), html("p", {class: "note"}, note));
}

function energySection(data) {
  const {equilibrium, structure} = data;
  if (equilibrium.energies.length !== structure.hinges.length || !data.states.flat)
    return missing("The energy of each hinge was not recorded.");
  return [
    html(
        "p", {class: "lead"},
        "The flat layout from above, every hinge coloured by the energy it holds in the last state. " +
            "Each picture has its own scale."),
    html(
        "div", {class: structure.columns > 3 * Math.max(1, structure.rows) ? "heats long" : "heats"},
        heatFigure(
            data, "stretch", "Stretch",
            "Hinge points and axes pulled apart. Ideal hinges do not allow this."),
        heatFigure(
            data, "turn", "Rotation",
            "Hinges turned from flat. This energy resists the fold.")),
  ];
}
