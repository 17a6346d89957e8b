// Draws the formulas of a page; one that cannot be drawn stays as it was written.
for (const element of document.querySelectorAll(".formula")) {
  const block = element.classList.contains("block");
  katex.render(element.textContent, element, { displayMode: block, throwOnError: false, output: "htmlAndMathml" });
}
