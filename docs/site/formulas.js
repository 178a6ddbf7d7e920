// SPDX-License-Identifier: BSD-3-Clause
// Typesets the formulas of a page; without this script each is shown as it is written in its source.
document.addEventListener("DOMContentLoaded", () => {
  for (const element of document.querySelectorAll(".formulas .tex")) {
    const source = element.textContent;
    katex.render(element.dataset.tex, element, { displayMode: false, strict: false, throwOnError: true });
    element.title = source;
  }
});
