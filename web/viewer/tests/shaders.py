#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The viewer's shaders, compiled and run by the system's OpenGL ES 3 without a window (EGL of Mesa, also in software):
colours, picking, sections, hidden bodies, sieves, mirror images, rings. Exit code 77 where there is no OpenGL ES 3.

Usage: shaders.py SHADERS.js [PICTURE.png CLOUD.wpv.gz FIELD]     the second form draws a cloud, to be looked at
"""
import ctypes
import gzip
import json
import pathlib
import re
import struct
import sys
import zlib
from ctypes import byref, c_char_p, c_float, c_int, c_uint, c_void_p

SIZE = 200
SKIP = 77
VERTEX, FRAGMENT, POINTS, ARRAY_BUFFER, TEXTURE_2D = 0x8B31, 0x8B30, 0, 0x8892, 0x0DE1
FLOAT, UNSIGNED_BYTE, UNSIGNED_SHORT, RGBA, RG, RGBA8, RG32F = 0x1406, 0x1401, 0x1403, 0x1908, 0x8227, 0x8058, 0x8230
IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]


def skip(reason):
    print(f"SKIPPED: {reason}: the shaders were not compiled", file=sys.stderr)
    sys.exit(SKIP)


def context():
    """OpenGL ES 3 without a window."""
    try:
        egl, gl = ctypes.CDLL("libEGL.so.1"), ctypes.CDLL("libGLESv2.so.2")
    except OSError as error:
        skip(str(error))
    egl.eglGetPlatformDisplay.restype = egl.eglCreateContext.restype = c_void_p
    egl.eglGetPlatformDisplay.argtypes = [c_uint, c_void_p, c_void_p]
    display = c_void_p(egl.eglGetPlatformDisplay(0x31DD, None, None))  # EGL_PLATFORM_SURFACELESS_MESA
    if not display or not egl.eglInitialize(display, None, None):
        skip("no display of EGL")
    egl.eglBindAPI(0x30A0)
    config, count = c_void_p(), c_int()
    wanted = (c_int * 5)(0x3040, 0x0040, 0x3033, 0, 0x3038)  # renderable by ES 3; any surface
    if not egl.eglChooseConfig(display, wanted, byref(config), 1, byref(count)) or count.value == 0:
        skip("no configuration for OpenGL ES 3")
    egl.eglCreateContext.argtypes = [c_void_p, c_void_p, c_void_p, c_void_p]
    made = c_void_p(egl.eglCreateContext(display, config, None, (c_int * 3)(0x3098, 3, 0x3038)))
    if not made or not egl.eglMakeCurrent(display, None, None, made):
        skip("no context of OpenGL ES 3")
    return gl


def compiled(gl, source):
    program = gl.glCreateProgram()
    for kind, name in ((VERTEX, "VERTEX_SHADER"), (FRAGMENT, "FRAGMENT_SHADER")):
        text = re.search(rf"{name} = `(.*?)`", source, re.DOTALL).group(1).encode()
        shader = gl.glCreateShader(kind)
        gl.glShaderSource(shader, 1, byref(c_char_p(text)), None)
        gl.glCompileShader(shader)
        good, message = c_int(), ctypes.create_string_buffer(4000)
        gl.glGetShaderiv(shader, 0x8B81, byref(good))
        gl.glGetShaderInfoLog(shader, 4000, None, message)
        if not good.value:
            sys.exit(f"{name}: {message.value.decode()}")
        gl.glAttachShader(program, shader)
    gl.glLinkProgram(program)
    linked = c_int()
    gl.glGetProgramiv(program, 0x8B82, byref(linked))
    if not linked.value:
        sys.exit("the shaders do not link")
    gl.glUseProgram(program)
    return program


class Scene:
    """Points with the stored values x, y, z, shown, sieved, body; drawn as the viewer's picture.js does."""

    def __init__(self, gl, program, size=SIZE):
        self.gl, self.program, self.size = gl, program, size
        target, depth = c_uint(), c_uint()
        frame = c_uint()
        gl.glGenTextures(1, byref(target))
        gl.glBindTexture(TEXTURE_2D, target)
        gl.glTexImage2D(TEXTURE_2D, 0, RGBA8, size, size, 0, RGBA, UNSIGNED_BYTE, None)
        gl.glGenRenderbuffers(1, byref(depth))
        gl.glBindRenderbuffer(0x8D41, depth)
        gl.glRenderbufferStorage(0x8D41, 0x81A6, size, size)
        gl.glGenFramebuffers(1, byref(frame))
        gl.glBindFramebuffer(0x8D40, frame)
        gl.glFramebufferTexture2D(0x8D40, 0x8CE0, TEXTURE_2D, target, 0)
        gl.glFramebufferRenderbuffer(0x8D40, 0x8D00, 0x8D41, depth)
        assert gl.glCheckFramebufferStatus(0x8D40) == 0x8CD5
        gl.glViewport(0, 0, size, size)
        gl.glEnable(0x0B71)
        gl.glClearColor.argtypes = [c_float] * 4
        gl.glUniform1f.argtypes = [c_int, c_float]
        gl.glVertexAttribPointer.argtypes = [c_uint, c_int, c_uint, ctypes.c_ubyte, c_int, c_void_p]
        gl.glBufferData.argtypes = [c_uint, ctypes.c_ssize_t, c_void_p, c_uint]
        self.uniforms = {
            "lower": [-1, -1, -1], "size": [2, 2, 2], "view": IDENTITY, "projection": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0],
            "mirrors": [0, 0, 0], "planes": [0, 0, 0], "rings": 0, "section": [0, 0, 0, 1], "sieve": [-1, 1e9], "field": [0, 65534],
            "codes": False, "range": [0, 65534], "logarithmic": False, "steps": 65534.0, "height": float(size), "enlarged": 1.0,
            "widest": 64.0, "depths": [0, 100], "every": 1, "bodies": 1, "colours": 0, "picking": False, "background": [0, 0, 0]}
        self.texture(0, RGBA, UNSIGNED_BYTE, RGBA8, bytes(v for i in range(256) for v in (i, 255 - i, 64, 255)))
        self.bodies([(0.05, 1), (0.05, 1)])

    def texture(self, unit, form, kind, internal, values):
        made = c_uint()
        self.gl.glActiveTexture(0x84C0 + unit)
        self.gl.glGenTextures(1, byref(made))
        self.gl.glBindTexture(TEXTURE_2D, made)
        self.gl.glTexImage2D(TEXTURE_2D, 0, internal, 256, 1, 0, form, kind, values)
        for name, value in ((0x2801, 0x2600), (0x2800, 0x2600), (0x2802, 0x812F), (0x2803, 0x812F)):  # nearest, clamped
            self.gl.glTexParameteri(TEXTURE_2D, name, value)

    def bodies(self, values):
        rows = [*values, *[(0, 0)] * (256 - len(values))]
        self.texture(1, RG, FLOAT, RG32F, struct.pack("512f", *(v for row in rows for v in row)))

    def set(self):
        for name, value in self.uniforms.items():
            at = self.gl.glGetUniformLocation(self.program, name.encode())
            assert at >= 0, f"the shaders do not use {name}"
            if isinstance(value, (bool, int)):
                self.gl.glUniform1i(at, int(value))
            elif isinstance(value, float):
                self.gl.glUniform1f(at, value)
            elif len(value) == 16:
                self.gl.glUniformMatrix4fv(at, 1, 0, (c_float * 16)(*value))
            else:
                getattr(self.gl, f"glUniform{len(value)}fv")(at, 1, (c_float * len(value))(*value))

    def draw(self, planes, count, copies=1):
        """@param planes  bytes and width of the six attributes"""
        self.set()
        for location, (values, width) in enumerate(planes):
            buffer = c_uint()
            self.gl.glGenBuffers(1, byref(buffer))
            self.gl.glBindBuffer(ARRAY_BUFFER, buffer)
            self.gl.glBufferData(ARRAY_BUFFER, len(values), values, 0x88E4)
            self.gl.glEnableVertexAttribArray(location)
            every = self.uniforms["every"]
            self.gl.glVertexAttribPointer(location, 1, UNSIGNED_SHORT if width == 2 else UNSIGNED_BYTE, location < 3, every * width, None)
        self.gl.glClearColor(0, 0, 0, 0)
        self.gl.glClear(0x4100)
        self.gl.glDrawArraysInstanced(POINTS, 0, -(-count // self.uniforms["every"]), copies)
        pixels = (ctypes.c_ubyte * (4 * self.size * self.size))()
        self.gl.glReadPixels(0, 0, self.size, self.size, RGBA, UNSIGNED_BYTE, pixels)
        assert self.gl.glGetError() == 0
        return bytes(pixels)

    def points(self, rows, copies=1):
        pixels = self.draw([(struct.pack(f"{len(rows)}H", *(row[k] for row in rows)), 2) for k in range(6)], len(rows), copies)
        return lambda x, y: tuple(pixels[4 * (int((0.5 + 0.5 * y) * self.size) * self.size + int((0.5 + 0.5 * x) * self.size)):][:4])


def stored(x):
    return round((x + 1) / 2 * 65535)


def check(gl, program):
    """The eye is at the origin and looks along -z; points at z = -1 are seen at their x and y."""
    def scene(**uniforms):
        made = Scene(gl, program)
        made.uniforms.update(uniforms)
        return made

    def point(x, y, shown=0, sieved=0, body=0, z=-1.0):
        return (stored(x), stored(y), stored(z), shown, sieved, body)

    two = [point(-0.5, 0.0, shown=0), point(0.5, 0.0, shown=65534, sieved=100, body=1)]
    empty = (0, 0, 0, 0)
    at = scene().points(two)
    low, high = at(-0.5, 0.0), at(0.5, 0.0)
    assert low[1] > 200 > 60 > low[0] and high[0] > 200 > 60 > high[1], (low, high)
    assert at(0.0, 0.0)[:3] == (0, 0, 0)
    assert at(-0.5 + 0.04, 0.04)[:3] == (0, 0, 0), "the corner of a disc is drawn"
    edge = at(-0.5 + 0.04, 0.0)
    assert 0 < edge[1] < low[1], "discs are not shaded"
    # Picking: the number of the particle from 1, and the copy.
    at = scene(picking=True).points(two)
    assert at(-0.5, 0.0) == (1, 0, 0, 0) and at(0.5, 0.0) == (2, 0, 0, 0) and at(0, 0) == empty
    at = scene(picking=True, every=2).points([*two, point(0.0, 0.5)])
    assert at(0.0, 0.5) == (3, 0, 0, 0) and at(0.5, 0.0) == empty, "levels of detail pick wrongly"
    # What is left out.
    at = scene(picking=True, section=[1, 0, 0, 0.1]).points(two)
    assert at(-0.5, 0.0) != empty and at(0.5, 0.0) == empty
    at = scene(picking=True, sieve=[50, 200]).points(two)
    assert at(-0.5, 0.0) == empty and at(0.5, 0.0) != empty
    hidden = scene(picking=True)
    hidden.bodies([(0.05, 1), (0.05, 0)])
    at = hidden.points(two)
    assert at(-0.5, 0.0) != empty and at(0.5, 0.0) == empty
    # Copies.
    one = [point(0.3, 0.4)]
    at = scene(picking=True, mirrors=[1, 1, 0]).points(one, copies=4)
    assert [at(0.3, 0.4)[3], at(-0.3, 0.4)[3], at(0.3, -0.4)[3], at(-0.3, -0.4)[3]] == [0, 1, 2, 3]
    away = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 1]
    at = scene(picking=True, rings=4, view=away).points([point(0.3, 0.4, z=0.0)], copies=4)
    assert at(0.3, 0.4)[3] == 0 and at(0.3, -0.4)[3] == 2 and at(0.3, 0.4)[0] == 1, "rings"
    # Codes, missing values, logarithms.
    at = scene(codes=True).points([point(0, 0, shown=255)])
    assert at(0, 0)[0] > 200 > 60 > at(0, 0)[1]
    at = scene().points([point(0, 0, shown=65535)])
    assert at(0, 0)[0] == at(0, 0)[1] == at(0, 0)[2] > 100, "what is missing is not grey"
    at = scene(logarithmic=True, field=[1, 10000], range=[1, 10000]).points([point(0, 0, shown=round(65534 * 99 / 9999))])
    assert abs(at(0, 0)[0] - at(0, 0)[1]) < 8, f"100 is not in the middle of 1 to 10000: {at(0, 0)}"
    # The nearer of two hides the other.
    at = scene(picking=True).points([point(0, 0, z=-0.99), point(0, 0, z=-0.5)])
    assert at(0, 0) == (2, 0, 0, 0)


def png(path, size, pixels):
    rows = b"".join(b"\0" + pixels[4 * size * y:4 * size * (y + 1)] for y in reversed(range(size)))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 6, 0, 0, 0))
                                   + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def draw(gl, program, picture, cloud, name):
    """A cloud as it is seen at first, by the matrices of camera.js."""
    data = gzip.decompress(pathlib.Path(cloud).read_bytes())
    length = struct.unpack_from("<I", data, 4)[0]
    head = json.loads(data[8:8 + length])
    at, planes = 8 + length, {}
    for plane, width in [("x", 2), ("y", 2), ("z", 2), *((f["name"], {"u8": 1, "u16": 2, "u32": 4}[f["type"]]) for f in head["fields"])]:
        planes[plane] = (data[at:at + width * head["n"]], width)
        at += -(-width * head["n"] // 4) * 4
    field = next(f for f in head["fields"] if f["name"] == name)
    import subprocess
    folder = pathlib.Path(sys.argv[1]).resolve().parent
    mirrors = [int(m is not None) for m in head["mirrors"]]
    script = (f"import {{ viewMatrix, projectionMatrix }} from '{folder}/camera.js'; import {{ resetCamera }} from '{folder}/viewer.js';"
              f"import {{ colourTable }} from '{folder}/colours.js'; import {{ completionOf }} from '{folder}/copies.js';"
              f"const head = {json.dumps(head)}, state = {{ completed: true }}; resetCamera(state, {{ head }});"
              "console.log(JSON.stringify({ view: viewMatrix(state.camera), projection: projectionMatrix(state.camera, 1),"
              f"colours: [...colourTable({json.dumps('words' if field.get('codes') else 'viridis')})], c: completionOf(head, true) }}))")
    made = json.loads(subprocess.run(["node", "--input-type=module", "-e", script], check=True, capture_output=True, text=True).stdout)
    scene = Scene(gl, program, 900)
    scene.bodies([(0.5 * b["spacing"], 1) for b in head["bodies"]])
    scene.texture(0, RGBA, UNSIGNED_BYTE, RGBA8, bytes(made["colours"]))
    scene.uniforms.update(lower=head["lower"], size=[b - a for a, b in zip(head["lower"], head["upper"])], view=made["view"],
                          projection=made["projection"], codes=bool(field.get("codes")), height=900.0,
                          mirrors=made["c"]["mirrors"], planes=made["c"]["planes"], rings=made["c"]["rings"])
    if not field.get("codes"):
        scene.uniforms.update(field=[field["lo"], field["hi"]], range=[field["lo"], field["hi"]])
    shown = planes[name]
    png(picture, 900, scene.draw([planes["x"], planes["y"], planes["z"], shown, shown, planes["body"]], head["n"], made["c"]["count"]))


def main():
    gl = context()
    program = compiled(gl, pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    if len(sys.argv) > 2:
        draw(gl, program, *sys.argv[2:])
    else:
        check(gl, program)
    print("the shaders compile and draw what they should")


if __name__ == "__main__":
    main()
