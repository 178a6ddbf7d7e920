#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a folder with a Debian of its own: an empty one to install packages in, one to build in, or the libraries for another
processor, unpacked only, to cross-compile with (cmake/aarch64.cmake). As root, with mmdebstrap, from a mirror of Debian.

Usage: scripts/debian_root.py FOLDER [--suite trixie] [--architecture arm64] [--build] [--mirror http://...]
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys

SCRIPTS = pathlib.Path(__file__).resolve().parent
# Without a home the compiler wrappers of Open MPI 5 do not start.
ENVIRONMENT = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND": "noninteractive", "LANG": "C.UTF-8", "HOME": "/root"}
# Links that Debian makes when it installs, which does not happen to files that are unpacked only.
ALTERNATIVES = ("blas/libblas.so.3", "lapack/liblapack.so.3")


def build_packages():
    """Return the names of the packages that the project is built from (scripts/install_deps.sh)."""
    return subprocess.run([SCRIPTS / "install_deps.sh", "--names"], check=True, stdout=subprocess.PIPE, text=True).stdout.split()


def library_packages():
    """Return those of them that hold what programs are compiled and linked with, and the library of the compiler."""
    libraries = [name for name in build_packages() if name.endswith("-dev") and name not in ("python3-dev", "pybind11-dev")]
    return [*libraries, "lammps", "lammps-data", "libc6-dev", "libstdc++-12-dev"]


def obstacle():
    """Return why no root can be made here, or nothing."""
    if os.geteuid() != 0:
        return "only root can make one"
    if not shutil.which("mmdebstrap"):
        return "mmdebstrap is missing (scripts/install_deps.sh --roots)"
    return ""


def make_root(folder, suite="bookworm", packages=(), mirror=None):
    """Install the smallest Debian, and packages, in a folder, which is emptied before."""
    _bootstrap(folder, "minbase", suite, packages, mirror)


def unpack_root(folder, architecture, suite="bookworm", packages=(), mirror=None):
    """Unpack packages for another processor, and what they depend on, in a folder, which is emptied before."""
    _bootstrap(folder, "extract", suite, packages, mirror, f"--architectures={architecture}")
    _mend_links(folder)


def inside(folder, sources=None):
    """Return the words that start a command in a root; `sources`: a folder to be seen there as /source, read only."""
    also = f"mkdir -p {folder}/source; mount --bind -o ro {sources} {folder}/source; " if sources else ""
    mounts = f"mount -t proc proc {folder}/proc; mount --rbind /sys {folder}/sys; {also}"
    return ("unshare", "--mount", "sh", "-c", f"{mounts}exec chroot {folder} \"$@\"", "sh")


def _bootstrap(folder, variant, suite, packages, mirror, *more):
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    include = [f"--include={','.join(packages)}"] if packages else []
    subprocess.run(["mmdebstrap", "--quiet", f"--variant={variant}", *more, *include, suite, folder, *([mirror] if mirror else [])], check=True)


def _mend_links(folder):
    """Let absolute links point to files of the folder, and add those of ALTERNATIVES."""
    root = os.path.realpath(folder)
    for parent, folders, files in os.walk(root):
        if parent == f"{root}/dev":
            continue
        for path in (os.path.join(parent, name) for name in folders + files):
            if os.path.islink(path) and (target := os.readlink(path)).startswith("/"):
                os.unlink(path)
                os.symlink(os.path.relpath(root + target, parent), path)
    for library in pathlib.Path(root, "usr/lib").glob("*-linux-gnu*"):
        for path in ALTERNATIVES:
            link = library / pathlib.Path(path).name
            if (library / path).exists() and not link.exists():
                link.symlink_to(path)


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--suite", default="bookworm")
    parser.add_argument("--architecture", help="unpack the libraries for it, install nothing")
    parser.add_argument("--build", action="store_true", help="with what the project is built from, and clang")
    parser.add_argument("--mirror")
    options = parser.parse_args(arguments)
    if why := obstacle():
        sys.exit(f"{options.folder}: {why}")
    if options.architecture:
        unpack_root(options.folder, options.architecture, options.suite, library_packages(), options.mirror)
    else:
        make_root(options.folder, options.suite, [*build_packages(), "clang", "libomp-dev"] if options.build else [], options.mirror)


if __name__ == "__main__":
    main(sys.argv[1:])
