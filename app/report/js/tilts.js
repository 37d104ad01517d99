// Tilts per column, as bars and as a table to copy.

/** Returns the hinge of each column's front wall along x. */
function tiltsByColumn(structure) {
  const tilts = new Map();
  for (const hinge of structure.hinges)
    if (hinge.along === "x" && (!tilts.has(hinge.column) || hinge.row < tilts.get(hinge.column).row))
      tilts.set(hinge.column, hinge);
  return tilts;
}

function drawTilts(data, width) {
  const {structure} = data, tilts = [...tiltsByColumn(structure).values()];
  const values = tilts.map((hinge) => toDegrees(hinge.beta)), largest = largestTilt(structure);
  const range = padded([Math.min(0, ...values), Math.max(0, ...values)]);
  const axes = plot({
    width,
    height: 220,
    label: "Tilt of each column",
    x: columnAxis(structure, width),
    y: {range, label: "tilt \u03b2 of the front wall, degrees"}
  });
  axes.root.append(
      ...tilts.map(
          (hinge, k) =>
              bar(axes, hinge.column, values[k], {fill: tiltColour(hinge.beta, largest), class: "bar"})),
      svg("path", {class: "zero", d: path([[axes.area.left, axes.Y(0)], [axes.area.right, axes.Y(0)]])}));
  return axes.root;
}

function tiltRows(data) {
  const turns = new Map((data.goal?.turn ?? []).map((turn) => [turn.column, turn]));
  return [...tiltsByColumn(data.structure).entries()]
      .sort((a, b) => a[0] - b[0])
      .map(([column,
             hinge]) => ({column, tilt: toDegrees(hinge.beta), t: hinge.t, turn: turns.get(column) ?? null}));
}

function asText(rows) {
  const cell = (value) => (finite(value) === null ? "" : String(Number(value.toFixed(4))));
  const line =
      (row) => [row.column, cell(row.tilt), cell(row.t), cell(row.turn?.needed), cell(row.turn?.allowed)]
                   .join("\t");
  return ["column\ttilt_deg\thinge_t\tturn_needed_deg\tturn_allowed_deg", ...rows.map(line)].join("\n") +
      "\n";
}

function copyBySelection(text) {
  const focused = document.activeElement, area = html("textarea", {class: "offscreen", readonly: ""}, text);
  document.body.append(area);
  area.select();
  const done = document.execCommand("copy");
  area.remove();
  focused?.focus();
  return done;
}

/** Formats all hinges of the sheet as a table, for use in other programs. */
function hingesAsText({hinges}) {
  const number = (value) => String(Number(value.toFixed(4)));
  const isSquare = hinges.every((h) => h.along);
  const line =
      (h) => [...(isSquare ? [h.along, h.column, h.row] : h.ends), number(h.t), number(toDegrees(h.alpha)), number(toDegrees(h.beta)),
              number(h.offset)]
                 .join("\t");
  const wall = isSquare ? "wall_along\tcolumn\trow" : "from_vertex\tto_vertex";
  return [wall + "\tt\talpha_deg\tbeta_deg\toffset_mm", ...hinges.map(line)].join("\n") + "\n";
}

function copyButton(label, text) {
  const button = html("button", {type: "button", class: "copy"}, label);
  const say = (done) => {
    button.textContent = done ? "Copied" : "Could not copy";
  };
  button.addEventListener("click", () => {
    if (!navigator.clipboard) return say(copyBySelection(text));
    navigator.clipboard.writeText(text).then(() => say(true), () => say(copyBySelection(text)));
  });
  return button;
}

/** Makes tables side by side, so that 80 columns do not fill a page. */
function tiltTables(rows) {
  const perBlock = Math.ceil(rows.length / Math.min(4, Math.ceil(rows.length / 8))), blocks = [];
  for (let k = 0; k < rows.length; k += perBlock) blocks.push(rows.slice(k, k + perBlock));
  const cells = (row) =>
      ({cells: [String(row.column), withSign(row.tilt, Math.abs(row.tilt).toFixed(2)), figures(row.t, 3)]});
  return html(
      "div", {class: "blocks"},
      blocks.map(
          (block) => table(["column", "tilt, \u00b0", "hinge at"], block.map(cells), "Tilts per column")));
}

function tiltSection(data) {
  const rows = tiltRows(data);
  if (!rows.length) return missing("This result holds no columns.");
  return [
    largestTilt(data.structure) > 1e-4 ?
        responsive((width) => drawTilts(data, width)) :
        html("p", {class: "lead"}, "All walls stand upright: every tilt is 0."),
    html(
        "div", {class: "row"},
        html(
            "p", {class: "note"},
            "Neighbours of opposite sign bend the strip the same way; of equal sign they cancel. " +
                "\u201cHinge at\u201d is the place of the hinge along its wall, 0 to 1 from the left. ",
            html("span", {class: "on-screen"}, "The copied table also holds the turns.")),
        html(
            "div", {class: "buttons"}, copyButton("Copy table", asText(rows)),
            copyButton("Copy all hinges", hingesAsText(data.structure)))),
    tiltTables(rows),
  ];
}
