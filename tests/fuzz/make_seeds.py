#!/usr/bin/env python3
"""Write the seed corpora of the fuzz targets: make_seeds.py FOLDER -> FOLDER/{ptf,record,obj,ply,gltf,triangulate}/*.

Each is the smallest file that reaches one branch of a reader. Standard library only.
"""
import base64, gzip, json, lzma, pathlib, struct, sys

POINTS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0.5)]
CONCAVE = [(0, 0, 0), (2, 0, 0), (0.5, 0.5, 0), (0, 2, 0)]


def ptf():
    draw = struct.pack("<12I10f4i24x", 1, 7, 0, 0x80B, 1, 4, 0, 6, 0, 4, 0, 0, 0, 8, 8, -8, 0, 1, 0, 0, 0, 0,
                       0, 0, 1 << 24, 1 << 24)
    clear = struct.pack("<12I10f4i24x", 2, 6, 0, 0x60000, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0,
                        0, 0, 8, 8)
    targets = struct.pack("<8I", 8, 8, 1, 2, 1, 1, 0, 0) + struct.pack("<8I", 4, 4, 1, 0, 1, 0, 0xFFFFFFFF, 0)
    vertices = b"".join(struct.pack("<4f", *p, 1) for p in POINTS)
    indices = struct.pack("<6I", 0, 1, 2, 0, 2, 3)
    meta = b"{}"
    header = struct.pack("<4s9I24x", b"PTF1", 1, 64, 32, 128, 2, 2, 4, 6, len(meta))
    plain = header + targets + clear + draw + vertices + indices + meta
    tails = struct.pack("<4s9I24x", b"PTF1", 1, 68, 36, 132, 1, 1, 0, 0, 0) + bytes(4)
    tails += targets[:32] + bytes(4) + clear + bytes(4)
    return {"plain": plain, "empty": header[:20] + bytes(44), "tails": tails, "gzip": gzip.compress(plain, mtime=0),
            "xz": lzma.compress(plain), "xz_no_check": lzma.compress(plain, check=lzma.CHECK_NONE),
            "gzip_twice": gzip.compress(plain[:99], mtime=0) + gzip.compress(plain[99:], mtime=0)}


def record():
    def text(t):
        return struct.pack("<I", len(t)) + t

    def words(*rows):  # a list: its length, and the words of its items
        return struct.pack("<I", len(rows)) + b"".join(struct.pack("<%dI" % len(r), *r) for r in rows)

    head = struct.pack("<4sI", b"HSRC", 1) + text(b"seed")
    draw = (0, 0, 1, 2, 1)  # kind, surface, touches depth, triangles, dropped after
    body = words((2, 4, 4)) + words((2, 0, 0, 0, 0), draw) + words((1, 2, 0), (0, 1, 3))
    body += words((4 << 24,), (2,), (16 << 24 | 1,)) + words((0x13000000,), (0x3F001001,))
    small = text(b"[z_cache]\nlines = 1\nways = 1\n")
    return {"plain": head + text(b"") + body, "small": head + small + body,
            "empty": head + text(b"") + words() * 5}


def obj():
    v = "".join("v %g %g %g\n" % p for p in POINTS)
    concave = "".join("v %g %g %g\n" % p for p in CONCAVE)
    return {"quad": v + "f 1 2 3 4\n", "negative": v + "vt 0 0\nvn 0 0 1\nf -4/1/1 -3//1 -2/1\n",
            "materials": "mtllib a.mtl\no thing\n" + v + "usemtl red\nf 1 2 3\ng a b\nusemtl blue\nf 1 3 4\n",
            "concave": concave + "f 1 2 3 4\n", "skipped": v + "p 1\nl 1 2 3\nf 1 2 3\r\n# end\n",
            "numbers": "v 1e-3 -.5 +2.\nv 1e38 1 1 1 0 0 0\nv 0 0 0\nf 1 2 3\n", "bad": "v a b c\nf 0 1 9\n",
            "mark": "\ufeff" + v + "f 1 2 3\n", "utf16": b"\xff\xfev\0 \0",
            "comments": "# \\\n" + v + "f 1 2 3#4\nf 1/1/1 2 3 # \\\nusemtl a #b\nf 1 2 4\n",
            "continued": "v 0 \\\n0 0\nv\\\r\n1 0 0\rv 0 1 0\nvn 1 \\ \n0 0\nf 1 2\\\n3 \\\n\nf 1 2 3\\",
            "not_finite": v + "v nan -inf 1.#QNAN\nv 1e400 -1e-400 1.#INF00\nf 1 2 5\nf 1 2\nf\nfo 1 2 3\n",
            "left_out": v + "curv 0 1 1 2\nsurf 0 1 0 1 1\nbzp 1\nnonsense\n\v\ff 1 2 3\ncall a.obj\n"}


def ply():
    head = "ply\nformat %s 1.0\ncomment x\nelement vertex 4\nproperty %s x\nproperty %s y\nproperty %s z\n%s"
    faces = "element face %d\nproperty list uchar int vertex_indices\nend_header\n"
    text = "".join("%g %g %g\n" % p for p in POINTS)
    out = {"ascii": head % ("ascii", "float", "float", "float", faces % 2) + text + "3 0 1 2\n4 0 1 2 3\n",
           "concave": head % ("ascii", "double", "double", "double", faces % 1)
           + "".join("%g %g %g\n" % p for p in CONCAVE) + "4 0 1 2 3\n",
           "edges": head % ("ascii", "int", "short", "char", "property uchar red\nelement edge 1\nproperty int vertex1\n"
                            "property list uint8 float64 w\n" + faces % 1)
           + "0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 1 1\n0 2 5 6\n3 0 1 2\n"}
    strips = "element tristrips 1\nproperty list int %s vertex_indices\nend_header\n"
    vertices = head % ("ascii", "float", "float", "float", "")
    out["strips"] = vertices + strips % "int" + text + "9 0 1 2 3 -1 0 1 2 -1\n"
    out["strips_uchar"] = vertices + strips % "uchar" + text + "6 -1 0 255 1 2 3\nmore"
    out["blanks"] = "\ufeffply \r" + out["ascii"][4:].replace("\n", " \t\r").replace("comment", "\tcomment")
    out["crlf"] = out["ascii"].replace("\n", "\r\n").replace("format", "obj_info\r\n\r\nformat")
    out["not_finite"] = vertices + faces % 3 + text.replace("1", "nan") + "3 0 1 2\n1 0\n4 0.0 +1 2e0 3\n"
    out["faces_first"] = (out["ascii"].split("element")[0] + "element" + (faces % 1).split("element")[1].split("end_header")[0]
                          + "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\nend_header\n3 2 1 0\n"
                          + "0 0 0 1 0 0 0 1 0\n")
    for order, name in (("<", "binary_little_endian"), (">", "binary_big_endian")):
        body = b"".join(struct.pack(order + "3f", *p) for p in POINTS) + struct.pack(order + "B4iB3i", 4, 0, 1, 2, 3, 3, 0, 1, 2)
        out["strips_" + name] = (head % (name, "uchar", "uchar", "uchar", "") + strips % "ushort").encode() + (
            bytes([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]) + struct.pack(order + "i6H", 6, 0, 1, 2, 65535, 1, 2) + b"tail")
        out[name] = (head % (name, "float32", "float32", "float32", faces % 2)).encode() + body
    return out


def glb_file(chunk, data):
    chunk += b" " * (-len(chunk) % 4)
    total = 12 + 8 + len(chunk) + 8 + len(data)
    return (struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(chunk), b"JSON") + chunk
            + struct.pack("<I4s", len(data), b"BIN\0") + data)


def gltf():
    points = b"".join(struct.pack("<3f", *p) for p in POINTS)
    data = points + struct.pack("<6H", 0, 1, 2, 0, 2, 3) + bytes([0, 1, 2, 3])

    def scene(**change):
        s = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
             "nodes": [{"children": [1], "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1]},
                       {"mesh": 0, "translation": [1, 0, 0], "rotation": [0, 0, 0, 1], "scale": [1, 2, 1]}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 4, "material": 0},
                                        {"attributes": {"POSITION": 0}, "indices": 2, "mode": 5},
                                        {"attributes": {"POSITION": 0}, "mode": 6},
                                        {"attributes": {"POSITION": 0}, "mode": 0}]}],
             "materials": [{"name": "red"}],
             "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                           {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                           {"bufferView": 2, "componentType": 5121, "count": 4, "type": "SCALAR"}],
             "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                             {"buffer": 0, "byteOffset": 60, "byteLength": 4}],
             "buffers": [{"byteLength": len(data)}]}
        s.update(change)
        return s

    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    text = json.dumps(scene(buffers=[{"byteLength": len(data), "uri": uri}])).encode()
    chunk = json.dumps(scene(images=[{"bufferView": 2, "mimeType": "image/png"}])).encode()
    glb = glb_file(chunk, data)
    other = json.dumps(scene(images=[{"uri": "a.png"}], textures=[{"source": 0}], extensionsUsed=["X"],
                             cameras=[{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
                             skins=[{"joints": [0]}], animations=[{"channels": [], "samplers": []}],
                             extras={"a": [1, {"b": None}]}, extensions={"KHR_lights_punctual": {"lights": []}},
                             samplers=[{}], buffers=[{"byteLength": len(data), "uri": uri}])).encode()
    return {"text.gltf": text, "binary.glb": glb, "other.gltf": other, "outside.gltf": json.dumps(
        scene(buffers=[{"byteLength": 4, "uri": "../a.bin"}])).encode(), **gltf_features()}


# The square of POINTS, packed by Draco's encoder (sequential, edgebreaker) and by meshoptimizer's (vertices, with the
# exponential filter too, triangles, an index sequence).
DRACO = {"sequential":
             "445241434f02020100000002040100010200020301030009030000040204000104090400020201000001010003030130"
             "011003003482880400000000ff03000000010100020301400100010000000000010000000000803f0000000000000000"
             "000000000000803f0000000000000000000000000000803f0000000000000000000000000000803f0000000000000000"
             "00000000000080bf000080bf00000000000000400a",
         "edgebreaker":
             "445241434f02020101000000040202020000011fff0111ff0111ff011103ff0000000000010000010009030000020104"
             "0204000101010409040002000101010003030130011003002882980000000000ff030000000080bf000080bf00000000"
             "000000400a01010100020301400100010000000000010000000000803f0000000000000000000000000000803f000000"
             "0000000000000000000000803f0000000000000000000000000000803f000000000000000000000000"}
MESHOPT = {"vertices":
               "a00000000133000000ffff000000010c000000ff000000000000000000000000000000000000000000000000000080bf"
               "000080bf00000000",
           "exponential":
               "a0000133000000807f01210000000000010c000000800108000000000000000000000000000000000000000000000000"
               "0000000000e0fff300e0fff3000000f3",
           "triangles": "e0f000007687566778a9866589689801690000", "indices": "d000040406080400000000"}


def gltf_features():
    """One file for each thing that places vertices, as a GLB of one square."""
    data = b""
    views = []

    def view(content):
        nonlocal data
        data += b"\0" * (-len(data) % 8)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(content)})
        data += content
        return len(views) - 1

    accessors = []

    def accessor(kind, component, count, **more):
        accessors.append({"type": kind, "componentType": component, "count": count, **more})
        return len(accessors) - 1

    def floats(kind, *values):
        size = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[kind]
        return accessor(kind, 5126, len(values) // size, bufferView=view(struct.pack("<%df" % len(values), *values)))

    def packed_view(name, mode, count, stride, **more):
        content = bytes.fromhex(MESHOPT[name])
        at = view(content)
        views[at] = {"buffer": 1, "byteLength": count * stride, "extensions": {"EXT_meshopt_compression": {
            **views[at], "mode": mode, "count": count, "byteStride": stride, **more}}}
        return at

    corners = [c for p in POINTS for c in p]
    position = floats("VEC3", *corners)
    indices = accessor("SCALAR", 5121, 6, bufferView=view(bytes([0, 1, 2, 0, 2, 3])))
    replaced = {"sparse": {"count": 1, "indices": {"bufferView": view(b"\2"), "componentType": 5121},
                           "values": {"bufferView": view(struct.pack("<3f", 2, 2, 2))}}}
    sparse = accessor("VEC3", 5126, 4, bufferView=0, **replaced)
    bare = accessor("VEC3", 5126, 4, **replaced)
    short = accessor("VEC3", 5122, 4, normalized=True, bufferView=view(struct.pack("<12h", *(int(c * 9999) for c in corners))))
    joints = accessor("VEC4", 5121, 4, bufferView=view(bytes([0, 1, 0, 0] * 4)))
    weights = floats("VEC4", *[0.5, 0.5, 0, 0] * 4)
    matrices = floats("MAT4", *([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] * 2))
    moves = floats("VEC3", 0, 0, 0, 3, 0, 0)
    turns = floats("VEC4", 0, 0, 0, 1, 0, 0, 1, 0)
    times = floats("SCALAR", 0, 1)
    free = accessor("VEC3", 5126, 4), accessor("SCALAR", 5123, 6)
    vertices = packed_view("vertices", "ATTRIBUTES", 4, 12)
    filtered = packed_view("exponential", "ATTRIBUTES", 4, 12, filter="EXPONENTIAL")
    packed = [(accessor("VEC3", 5126, 4, bufferView=v), accessor("SCALAR", component, 6, bufferView=i))
              for v, i, component in ((vertices, packed_view("triangles", "TRIANGLES", 6, 4), 5125),
                                      (filtered, packed_view("indices", "INDICES", 6, 2), 5123))]
    draco = {name: view(bytes.fromhex(content)) for name, content in DRACO.items()}

    def square(at=position, order=indices, **more):
        return {"attributes": {"POSITION": at}, "indices": order, **more}

    def glb(primitive, node=None, mesh=None, **more):
        root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
                "nodes": [{"mesh": 0, **(node or {})}, {"translation": [1, 0, 0]}],
                "meshes": [{"primitives": [primitive], **(mesh or {})}], "accessors": accessors, "bufferViews": views,
                "buffers": [{"byteLength": len(data)}, {"byteLength": 4096}], **more}
        return glb_file(json.dumps(root, separators=(",", ":")).encode(), data)

    def animation(path, output, interpolation):
        return {"channels": [{"sampler": 0, "target": {"node": 0, "path": path}}],
                "samplers": [{"input": times, "output": output, "interpolation": interpolation}]}

    skinned = square()
    skinned["attributes"].update({"JOINTS_0": joints, "WEIGHTS_0": weights})
    instanced = {"extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": moves, "ROTATION": turns}}}}
    out = {"sparse": glb(square(sparse)), "bare": glb(square(bare)), "short": glb(square(short)),
           "morph": glb(square(targets=[{"POSITION": bare}, {"POSITION": short}]), mesh={"weights": [0.5, 1]}),
           "skin": glb(skinned, {"skin": 0}, skins=[{"joints": [0, 1], "inverseBindMatrices": matrices}]),
           "instances": glb(square(), instanced),
           "animation": glb(square(), animations=[animation("translation", moves, "LINEAR"),
                                                  animation("rotation", turns, "CUBICSPLINE")]),
           "camera": glb(square(), {"camera": 0}, cameras=[{"type": "orthographic", "orthographic": {
               "xmag": 1, "ymag": 1, "znear": 0, "zfar": 9}}]),
           "hidden": glb(square(), {"extensions": {"KHR_node_visibility": {"visible": False}}})}
    for name, at in draco.items():
        extension = {"KHR_draco_mesh_compression": {"bufferView": at, "attributes": {"POSITION": 0}}}
        out["draco_" + name] = glb(square(*free, extensions=extension))
    for number, (at, order) in enumerate(packed):
        out["meshopt_%d" % number] = glb(square(at, order))
    return {name + ".glb": content for name, content in out.items()}


def triangulate():
    keyhole = [(0, 0), (9, 0), (9, 9), (0, 9), (0, 0), (3, 3), (3, 6), (6, 6), (6, 3), (3, 3)]
    whisker = [(0, 0), (4, 0), (4, 2), (7, 2), (4, 2), (4, 4), (0, 4)]
    bridge = [(0, 0), (2, 0), (2, 2), (4, 4), (6, 2), (8, 2), (8, 0), (9, 3), (6, 2), (4, 4), (2, 2), (0, 2)]
    lattice = {"keyhole": keyhole, "whisker": whisker, "bridge": bridge, "crossing": [(0, 0), (9, 9), (9, 0), (0, 8)]}
    seeds = {name: bytes([0]) + bytes(sum(points, ())) for name, points in lattice.items()}
    seeds["doubles"] = b"d" + b"".join(struct.pack("<3d", *p) for p in CONCAVE)
    return seeds


def main():
    folder = pathlib.Path(sys.argv[1])
    for kind, make in (("ptf", ptf), ("record", record), ("obj", obj), ("ply", ply), ("gltf", gltf),
                       ("triangulate", triangulate)):
        (folder / kind).mkdir(parents=True, exist_ok=True)
        for name, content in make().items():
            (folder / kind / name).write_bytes(content.encode() if isinstance(content, str) else content)


main()
