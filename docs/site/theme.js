// SPDX-License-Identifier: BSD-3-Clause
// Takes the place of Debian's furo.js, which imports a module and so runs nowhere: light or dark as the system has it,
// or as the reader chose.
const system = window.matchMedia("(prefers-color-scheme: dark)");
const chosen = () => localStorage.getItem("theme");
const show = () => { document.body.dataset.theme = chosen() ?? (system.matches ? "dark" : "light"); };
document.documentElement.classList.remove("no-js");
show();
system.addEventListener("change", show);
document.addEventListener("DOMContentLoaded", () => {
  for (const button of document.getElementsByClassName("theme-toggle")) {
    button.addEventListener("click", () => {
      localStorage.setItem("theme", document.body.dataset.theme === "dark" ? "light" : "dark");
      show();
    });
  }
  document.querySelector(".sidebar-tree .current-page > .reference")?.scrollIntoView({ block: "center" });
});
