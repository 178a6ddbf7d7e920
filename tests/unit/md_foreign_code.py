#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A plan and a material that lie beside a shared object or a script do not make anybody load or run it.

usage: md_foreign_code.py WHIPPLE
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path[0] = str(pathlib.Path(__file__).resolve().parent)
from checks import require  # noqa: E402

MODEL = "EAM_Dynamo_FoilesBaskesDaw_1986universal3_Cu__MO_666348409573_004"
LIBRARY = """
#include <fcntl.h>
#include <unistd.h>
__attribute__((constructor)) static void mark(void) { close(open("{folder}/ran", O_CREAT | O_WRONLY, 0600)); }
"""
PLAN = """title = "foreign"
element = "Cu"
{potential}
[zero_pressure_volume]
temperature = ["293 K"]
cells = 4
equilibration_steps = 100
steps = 200
"""
SCRIPT = 'open("{folder}/ran", "w").write("ran")\nclass _Style:\n    pass\n'
MATERIAL = f"""name = "simulated"
source = "test"
[eos]
model = "md"
element = "Cu"
potential = "{MODEL}"
temperature = ["300 K", "700 K", "1100 K"]
tolerance = "0.5 GPa"
"""


def main():
    whipple = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / MODEL).mkdir()
        source = folder / "library.c"
        source.write_text(LIBRARY.replace("{folder}", name))
        compiler = shutil.which("cc") or shutil.which("g++")
        subprocess.run([compiler, "-shared", "-fPIC", "-o", folder / MODEL / "libkim-api-portable-model.so", source], check=True)
        (folder / "evil.py").write_text(SCRIPT.replace("{folder}", name))
        (folder / "kim.toml").write_text(PLAN.replace("{potential}", f'potential = "{MODEL}"'))
        (folder / "python.toml").write_text(PLAN.replace(
            "{potential}", 'potential = "own"\npair_style = "python 6.0"\npair_coeff = ["* * evil._Style Cu"]'))
        (folder / "simulated.toml").write_text(MATERIAL)
        for words in (["md", "kim.toml", "-o", "kim.md.h5", "--ranks", "1"],
                      ["md", "python.toml", "-o", "python.md.h5", "--ranks", "1"],
                      ["eos", "state", "simulated.toml", "--pressure", "0 GPa", "--temperature", "300 K"]):
            done = subprocess.run([whipple, *words], cwd=folder, capture_output=True, text=True, timeout=120)
            said = done.stdout + done.stderr
            require(not (folder / "ran").exists(), f"{words}: foreign code ran\n{said}")
            require(done.returncode == 2, f"{words}: exit code {done.returncode}\n{said}")
        require("is refused: it may run code" in subprocess.run(
            [whipple, "md", "python.toml", "-o", "python.md.h5", "--ranks", "1"], cwd=folder, capture_output=True,
            text=True, timeout=120).stderr, "the message")


main()
