# SPDX-License-Identifier: BSD-3-Clause
"""The packages of cpack: what is in them, and the tarball from a folder of its own. With --install, those in FOLDER are
installed in an empty Debian 12: a user without rights follows the tutorials there, and removing the packages leaves
nothing. This takes mmdebstrap, the rights of root and a mirror of Debian, and therefore is done only if
WHIPPLE_DEBIAN_MIRROR is set in the environment (to a mirror, or to "default"); otherwise the exit code is 77.

Usage: packages.py BUILD_FOLDER ROOT FOLDER [--install]
"""
import pathlib
import shutil
import subprocess
import sys
import time

BUILD, ROOT, FOLDER = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
sys.path[:0] = [str(ROOT / path) for path in ("tests/unit", "tests/installed", "scripts")]
from checks import require  # noqa: E402
from debian_root import ENVIRONMENT, inside, make_root  # noqa: E402
from roots import mirror_or_skip  # noqa: E402

TUTORIALS = ("first_impact", "shield", "import", "steering", "own_metal", "python_study")  # all but that which compiles
PROGRAM, LIBRARY, PYTHON = "whipple", "libwhipple-dev", "python3-whipple"
HOLDS = {
    PROGRAM: ("usr/bin/whipple", "usr/bin/whipple-md", "usr/bin/whipple-fit", "usr/share/whipple/materials/copper.toml",
              "usr/share/man/man1/whipple.1.gz", "usr/share/bash-completion/completions/whipple",
              "usr/share/zsh/vendor-completions/_whipple", "usr/share/fish/vendor_completions.d/whipple.fish",
              "usr/share/whipple/cases/whipple_shield/case.toml", "usr/share/doc/whipple/copyright",
              "usr/share/doc/whipple/docs/tutorials/first_impact.md", "usr/share/doc/whipple/docs/manual/input_reference.md"),
    LIBRARY: ("usr/include/whipple/solver/simulation.hpp", "usr/share/doc/libwhipple-dev/copyright"),
    PYTHON: ("usr/lib/python3/dist-packages/whipple/runs.py", "usr/share/doc/python3-whipple/copyright"),
}


def output(*command, **options):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)
    require(done.returncode == 0, f"{' '.join(map(str, command))}: {done.returncode}\n{done.stdout[-3000:]}")
    return done.stdout


def check_contents(packages):
    for name, paths in HOLDS.items():
        held = {line.split()[5].removeprefix("./") for line in output("dpkg-deb", "-c", packages[name]).splitlines()}
        require(not (lost := set(paths) - held), f"{name} lacks {lost}")
        others = [path for other in HOLDS if other != name for path in HOLDS[other]]
        require(not held & set(others), f"{name} holds {held & set(others)}")
    require("libp4est" in output("dpkg-deb", "-f", packages[PROGRAM], "Depends"), "libraries that the program needs")
    files = FOLDER / "files"
    output("dpkg-deb", "-x", packages[PROGRAM], files)
    require("GPL-2+" in (files / "usr/share/doc/whipple/copyright").read_text(), "the licence of the executables")
    told = output(files / "usr/bin/whipple", "materials", cwd=FOLDER)
    require("copper" in told, "the program finds its materials beside itself")


def check_tarball(tarball):
    output("tar", "xzf", tarball, "-C", FOLDER)
    moved = FOLDER / "moved"
    next(FOLDER.glob("whipple-*-Linux")).rename(moved)
    output(moved / "bin/whipple", "check", "whipple_shield/case.toml", "--brief", cwd=moved / "share/whipple/cases")


class Clock:
    """Tells how long the parts of a newcomer's way take."""

    def __init__(self):
        self.begin = time.monotonic()

    def part(self, what):
        now = time.monotonic()
        print(f"{now - self.begin:5.0f} s  {what}", flush=True)
        self.begin = now


def check_clean_root(packages, mirror):
    root, clock = FOLDER / "root", Clock()
    make_root(root, mirror=mirror)
    (root / "packages").mkdir()
    for name in (PROGRAM, PYTHON):
        shutil.copy(packages[name], root / "packages")
    for file in (*(f"docs/tutorials/{name}.md" for name in TUTORIALS), "tests/unit/tutorial.py", "tests/unit/checks.py"):
        shutil.copy(ROOT / file, root / "packages")
    before = set(output("find", root / "usr", "-path", "*whipple*").splitlines())
    within = inside(root)
    clock.part("an empty Debian 12")
    output(*within, "apt-get", "update", "-qq", env=ENVIRONMENT)
    output(*within, "sh", "-c", "apt-get install -y -qq /packages/*.deb", env=ENVIRONMENT)
    clock.part("packages of the program and of Python, with what they depend on and recommend, fetched and installed")
    output(*within, "useradd", "--create-home", "user", env=ENVIRONMENT)
    user = (*within, "su", "user", "-c")
    require('"version"' in output(*user, "whipple version --json", env=ENVIRONMENT), "the version")
    clock.part("first start")
    for name in TUTORIALS:
        print(output(*user, f"/usr/bin/python3 /packages/tutorial.py /packages/{name}.md /home/user/{name} --within 600", env=ENVIRONMENT), end="")
        clock.part(f"commands of the tutorial {name}")
    output(*user, "/usr/bin/python3 -c 'import whipple.eos; whipple.eos.material(\"copper\")'", env=ENVIRONMENT)
    output(*within, "apt-get", "purge", "-y", "-qq", PROGRAM, PYTHON, env=ENVIRONMENT)
    after = set(output("find", root / "usr", "-path", "*whipple*").splitlines())
    require(after == before, f"left behind: {sorted(after - before)[:5]}")
    clock.part("removed")


def built():
    """Return the packages in the folder by their names."""
    found = {path.name.split("_")[0]: path for path in (FOLDER / "packages").glob("*.deb")}
    require(set(found) == set(HOLDS), f"packages: {sorted(found)}")
    return found


if "--install" in sys.argv:
    check_clean_root(built(), mirror_or_skip("installation into an empty Debian"))
else:
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    output("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", FOLDER / "packages", cwd=BUILD)
    check_contents(built())
    check_tarball(next((FOLDER / "packages").glob("*.tar.gz")))
