/** Shows the folding card: pictures with arrows, and what to do. */
function cardSection({card}) {
  const source = (text) => `data:image/svg+xml,${encodeURIComponent(text)}`;
  return [
    ...card.pictures.map(({svg: text, caption}) => html("figure", {class: "paper"}, html("img", {src: source(text), alt: String(caption)}), html("figcaption", {}, String(caption)))),
    html("ol", {}, card.steps.map(([title, how]) => html("li", {}, html("strong", {}, `${title}. `), String(how)))),
  ];
}
