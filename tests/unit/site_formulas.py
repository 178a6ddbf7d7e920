# SPDX-License-Identifier: BSD-3-Clause
"""Formulas as they are written in the documents become TeX that says the same; every numbered equation of the theory is
one that is understood, and KaTeX accepts it. Citations are found in sentences. Exit code 77 if all but KaTeX was asked,
because Node or KaTeX is missing.

Usage: site_formulas.py ROOT
"""
import json
import pathlib
import shutil
import subprocess
import sys

from checks import require

ROOT = pathlib.Path(sys.argv[1])
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "docs/site")]
import check_documents  # noqa: E402
import formulas  # noqa: E402
import sources  # noqa: E402

KATEX = "/usr/share/javascript/katex/katex.js"
SAME = (
    ("C_i = sum_p N_ip m_p c_p", r"C_{i} = \sum_{p} N_{ip} m_{p} c_{p}"),
    ("dt <= dx^2 / (18 a)", r"dt \le dx^{2} / (18 a)"),
    ("(3/2 - u)^2/2", r"\frac{\left(\frac{3}{2} - u\right)^{2}}{2}"),
    ("(m + 1/2)^-1/2", r"\left(m + \frac{1}{2}\right)^{-1/2}"),
    ("F (p - p0)^(1/3)", r"F (p - p_{0})^{1/3}"),
    ("d ln T_s/d ln rho = Gamma", r"d \ln T_{s}/d \ln \rho = \Gamma"),
    ("|g_p| dx < 0.02", r"\lvert g_{p} \rvert dx < 0.02"),
    ("N/(N-1) (<U> - U_c)", r"\frac{N}{N-1} (\langle U\rangle - U_{c})"),
    ("A (1 - D + p*/T*)", r"A \left(1 - D + \frac{p^{*}}{T^{*}}\right)"),
    ("g = g_e0 (V/V0)^gamma_e", r"g = g_{e0} \left(\frac{V}{V_{0}}\right)^{\gamma_{e}}"),
    ("(1 - x)^-(a - b)", r"(1 - x)^{-(a - b)}"),
    ("(1 - x)^-2(a - b) e^(a x)", r"(1 - x)^{-2(a - b)} e^{a x}"),
    ("chi^2_k = P1a + E_0H", r"\chi_{k}^{2} = P_{1a} + E_{0H}"),
    ("dD = dep/max{D1, eps_m}", r"dD = \frac{d\mathit{ep}}{\max\{D_{1}, \varepsilon_{m}\}}"),
    ("beta_1 = (f x b + c x e)/3", r"\beta_{1} = \frac{f \times b + c \times e}{3}"),
    ("3 x 1.54 e^(a x)/x", r"3 \times 1.54 \frac{e^{a x}}{x}"),
    ("2 x y + x_a x f_a", r"2 x y + x_{a} \times f_{a}"),
    ("0 if the gap is open, else e_p^{n+1}", None),
)


def main():
    for text, tex in SAME:
        made = formulas.tex_of(text)
        require(tex is None or made == tex, f"'{text}' became '{made}', not '{tex}'")
        require(tex is not None or r"\text{if the gap is open, else}" in made, f"words of '{text}': '{made}'")
    for wrong in ("f(x = 2", "a ] b", 'model = "p_alpha"', "{a)"):
        try:
            formulas.rows([f"    {wrong}"])
        except formulas.NoFormula:
            continue
        require(False, f"'{wrong}' is taken for a formula")
    text = "as Nairn, CMES 10 (2005) 9 (heat), and Hu et al. (ACM Trans. Graph. 37 (2018) 150); D. C. Drucker and W. Prager, Q.\nAppl. Math. 10 (1952) 157"
    require(list(sources.cited(text)) == [("Nairn", "2005", "Nairn, CMES 10 (2005) 9"),
                                          ("Hu et al.", "2018", "Hu et al., ACM Trans. Graph. 37 (2018) 150"),
                                          ("Drucker and W. Prager", "1952", "D. C. Drucker and W. Prager, Q. Appl. Math. 10 (1952) 157")],
            f"{list(sources.cited(text))}")
    found, numbers = [], 0
    for page in sorted((ROOT / "docs/theory").glob("*.md")):
        lines = page.read_text(encoding="utf-8").split("\n")
        for kind, begin, end in check_documents.blocks(lines):
            if kind != "code" or lines[begin].strip().startswith("```"):
                continue
            numbered = [line for line in lines[begin:end] if formulas.split(line)[0]]
            numbers += len(numbered)
            try:
                found += [(page.name, text, tex) for _, _, text, tex in formulas.rows(lines[begin:end])]
            except formulas.NoFormula as fault:
                require(not numbered, f"{page.name}:{begin + 1}: {fault}: {lines[begin].strip()}")
    require(numbers > 250, f"only {numbers} numbered equations in docs/theory")
    if shutil.which("node") is None or not pathlib.Path(KATEX).is_file():
        print(f"SKIPPED: whether KaTeX accepts {len(found)} formulas: no {KATEX}, or no Node (scripts/install_deps.sh --site)")
        sys.exit(77)
    script = f"const k = require('{KATEX}'); let n = 0;" \
        "for (const [page, text, tex] of JSON.parse(require('fs').readFileSync(0)))" \
        "try { k.renderToString(tex, { strict: false }); n++ } catch (e) { console.log(page, text, e.message) } console.log(n)"
    done = subprocess.run(["node", "-e", script], input=json.dumps(found), capture_output=True, text=True, check=True)
    require(done.stdout.split() == [str(len(found))], f"KaTeX refuses:\n{done.stdout}")
    print(f"KaTeX accepts {len(found)} formulas, {numbers} with numbers")


main()
