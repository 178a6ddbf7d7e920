# SPDX-License-Identifier: BSD-3-Clause
"""Files that are read as a whole, and written as a whole or not at all."""
import io
import os
import pathlib
import tempfile
from collections.abc import Callable
from typing import BinaryIO

import h5py
from matplotlib.figure import Figure


def open_hdf5(path: str | pathlib.Path) -> h5py.File:
    """Opens an HDF5 file to be read. Python reads it into memory: where the disk fails libhdf5, whose closing cannot be
    repeated, h5py ends with a segmentation fault instead of an OSError."""
    return h5py.File(io.BytesIO(pathlib.Path(path).read_bytes()), "r")


def write_whole(path: pathlib.Path, write: Callable[[BinaryIO], object]) -> None:
    """Lets `write(stream)` fill a file beside `path` that then takes its place: readers see the old or the new one."""
    mask = os.umask(0)
    os.umask(mask)
    with tempfile.NamedTemporaryFile(dir=path.parent, prefix=path.name + ".", suffix=".partial",
                                     delete=False) as stream:
        try:
            write(stream)
            stream.close()  # what a full disk does not take may show here
            os.chmod(stream.name, 0o666 & ~mask)
            os.replace(stream.name, path)
        except BaseException:
            os.unlink(stream.name)
            raise


def encoded(text: str) -> bytes:
    """UTF-8 of a text that may hold names of files, which are bytes of any kind."""
    return text.encode(errors="replace")


def save_figure(figure: Figure, path: str | pathlib.Path, **options) -> None:
    """Writes a figure in the format of its ending."""
    path = pathlib.Path(path)
    write_whole(path, lambda stream: figure.savefig(stream, format=path.suffix[1:], **options))
