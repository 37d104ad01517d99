// Convergence of the search, and speed against error of the models.

function positive(history) {
  const least = Math.min(...history.map(([, cost]) => cost).filter((cost) => cost > 0));
  return history.map(([at, cost]) => [at, cost > 0 ? cost : least]).filter(([,
                                                                             cost]) => Number.isFinite(cost));
}

/** Converts a history of best costs to a staircase line. */
function stairs(history) {
  return history.flatMap(([at, cost], k) => (k === 0 ? [[at, cost]] : [[at, history[k - 1][1]], [at, cost]]));
}

function bestRun(data) {
  const named = data.runs.find((run) => run.start === data.optimiser.best_start);
  if (named) return named;
  const known = data.runs.filter((run) => run.rms !== null);
  return known.length ? known.reduce((a, b) => (b.rms < a.rms ? b : a)) : null;
}

/** Returns the suffix of "error": "" for custom goals, which have a separate unit, else ", rms". */
function fitName({kind}) {
  return kind?.fitText ? "" : ", rms";
}

function drawConvergence(data, runs, width) {
  const points = runs.flatMap((run) => positive(run.history)), best = bestRun(data);
  const axes = plot({
    width,
    height: 280,
    label: "Best error so far against evaluations",
    x: {range: [0, Math.max(1, ...points.map((p) => p[0]))], label: "evaluations of the model"},
    y: {range: decades(points.map((p) => p[1])), log: true, label: `best error so far${fitName(data)} (log scale)`}
  });
  const line = (run) => svg("path", {
    class: run === best ? "start best" : "start",
    d: path(stairs(positive(run.history)).map(([at, cost]) => [axes.X(at), axes.Y(cost)]))
  });
  axes.root.append(...[...runs].sort((a, b) => (a === best) - (b === best)).map(line));
  return axes.root;
}

function startTable(data) {
  const best = bestRun(data), text = data.kind?.fitText ?? percent;
  const row = (run) => ({
    mark: run === best ? "best" : null,
    cells: [
      String(run.start) + (run === best ? " (best)" : ""), words(run.status) || DASH, text(run.rms),
      run.history.length ? String(run.history[run.history.length - 1][0]) : DASH
    ],
  });
  return html(
      "div", {class: "scroll"},
      table(
          ["start", "status", `fit error${fitName(data)}`, "evaluations"], data.runs.map(row),
          "Starts of the search"));
}

function describeSearch(starts) {
  if (starts === 1) return "The search started once.";
  return `The search started ${
      starts} times, from different designs. Each line is one start; the best is emphasised.`;
}

function searchSection(data) {
  if (!data.runs.length) return missing("The course of the search was not recorded.");
  const runs = data.runs.filter((run) => positive(run.history).length > 0);
  return [
    html("p", {class: "lead"}, describeSearch(data.runs.length)),
    runs.length ? responsive((width) => drawConvergence(data, runs, width)) : null,
    runs.length && legend(["start best", "best start"], data.runs.length > 1 && ["start", "other starts"]),
    startTable(data),
  ];
}

function modelClass(name) {
  if (/bullet|physics/i.test(name)) return "physics";
  return /^exact/i.test(name) ? "model" : "other";
}

/** Makes the label of a point: the number of its row in the table. */
function pointLabel(axes, x, y, number) {
  const toLeft = x > (axes.area.left + axes.area.right) / 2;
  return svg(
      "text", {
        class: "remark",
        x: x + (toLeft ? -9 : 9),
        y: y + (y > axes.area.bottom - 8 ? -8 : 4),
        "text-anchor": toLeft ? "end" : "start"
      },
      String(number));
}

function drawFidelity(entries, width) {
  const shown = entries.filter((e) => e.seconds > 0 && finite(e.error) !== null);
  const errors = shown.map((e) => e.error).filter((error) => error > 0);
  const [low, high] = decades(errors.length ? errors : [1e-3]);
  const floor = shown.some((e) => e.error <= 0) ? low / 10 : low;
  const ticks = floor < low ? [...logTicks([low, high], 6), {at: floor, text: "0"}] : undefined;
  const axes = plot({
    width,
    height: 280,
    label: "Error against time",
    x: {range: decades(shown.map((e) => e.seconds)), log: true, label: "time of one state, s (log scale)"},
    y: {range: [floor, high], log: true, ticks, label: "error, cell edges (log scale)"}
  });
  const at = (e) => [axes.X(e.seconds), axes.Y(e.error > 0 ? e.error : floor)];
  for (const e of shown) {
    const [cx, cy] = at(e);
    axes.root.append(
        svg("circle", {class: "dot " + modelClass(e.model), cx, cy, r: 5}),
        pointLabel(axes, cx, cy, entries.indexOf(e) + 1));
  }
  return axes.root;
}

function fidelitySection(data) {
  const entries = data.fidelity;
  if (!entries.length) return missing("Speed and error of the models were not measured for this scene.");
  const row = (e, k) => ({
    cells: [String(k + 1), words(e.model), duration(e.seconds), figures(e.error, 2), words(e.against) || DASH]
  });
  const drawable = entries.some((e) => e.seconds > 0 && finite(e.error) !== null);
  return [
    html(
        "p", {class: "lead"},
        "Several models can fold the same sheet. Left and low is better: fast and true. Numbers are the rows of the table."),
    drawable ? responsive((width) => drawFidelity(entries, width)) : null,
    html(
        "div", {class: "scroll"},
        table(
            ["", "model", "time of one state", "error, cell edges", "compared with"], entries.map(row),
            "Speed against error")),
  ];
}
