// Flat sheet at 1:1, on A4 pages to put side by side.

const PAGE_MM = [180, 250];  // A4 minus margins of 15 mm and a line of text
const ALONG_MM = 10;         // overlap of neighbouring pages, for alignment

/** Returns the windows of the pages that cover a box: {x: low, y: high, column, row}, row 0 at the top. */
function pagesOver({low, high}) {
  const step = PAGE_MM.map((side) => side - ALONG_MM), counts = [0, 1].map((k) => Math.max(1, Math.ceil((high[k] - low[k] - ALONG_MM) / step[k])));
  return Array.from({length: counts[0] * counts[1]}, (_, n) => {
    const column = n % counts[0], row = Math.floor(n / counts[0]);
    return {x: low[0] + column * step[0], y: high[1] - row * step[1], column, row, counts};
  });
}

function pageDrawing(data, {x, y, column, row}) {
  const {structure, states} = data, [width, height] = PAGE_MM, more = structure.cell;
  const to = ([a, b]) => [a - x, y - b];
  const inside = structure.hinges.filter(({point: [a, b]}) => a > x - more && a < x + width + more && b < y + more && b > y - height - more);
  const label = `Page ${column + 1} of row ${row + 1}`;
  const root = svg("svg", {width: `${width}mm`, height: `${height}mm`, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": label},
      flatWalls(structure, states.flat, to, inside),
      inside.map((hinge) => {
        const [cx, cy] = to(hinge.point);
        return svg("circle", {cx, cy, r: 0.09 * structure.cell, fill: tiltColour(hinge.beta, largestTilt(structure))});
      }),
      svg("path", {class: "crop", d: `M0,0H${width}V${height}H0Z`}));
  return html("figure", {class: "page"}, root, html("figcaption", {}, `${label}; 1:1, the frame is ${width} \u00d7 ${height} mm`));
}

function trueScale(data) {
  const {structure, states} = data;
  if (!states.flat || !structure.hinges.length) return null;
  const half = structure.thickness / 2, box = extent(structure.bodies.map(({rest}) => rest));
  const pages = pagesOver({low: box.low.map((v) => v - half), high: box.high.map((v) => v + half)}), [{counts}] = pages;
  const drawPages = ({target}) => {
    if (target.open && !target.querySelector(".page")) target.append(...pages.map((page) => pageDrawing(data, page)));
  };
  return html(
      "details", {class: "true-scale", toggle: drawPages}, html("summary", {}, `Flat layout at 1:1, ${count(pages.length, "page", "pages")} of A4`),
      html("p", {class: "note"}, `Open, then print at 100 %: ${counts[0]} \u00d7 ${counts[1]} pages, each of which shows ${ALONG_MM} mm of the next ones again.`));
}
