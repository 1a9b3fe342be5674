#!/usr/bin/env python3
"""OpenSim's files in data/opensim fit each other and what the program writes.

    opensim_test.py WALKTRACK SOURCE_FOLDER

OpenSim itself is in no Debian package; its documents are read here, and the Rajagopal model is put together from the
places of its joints: scaled as scale_setup.xml says and bent as angles.mot says, its markers have to be where joints.trc
has them. (The model's knee also slides by up to 7 mm and its ankle's axis is oblique; both are left out here.)
"""
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
FOLDER = SOURCE / "data/opensim"
# Rajagopal2015.osim: bodies, and of the right leg body -> parent, joint in the parent, joint in the body, metres.
BODIES = {"pelvis", "torso"} | {f"{name}_{side}" for side in "lr" for name in (
    "femur", "tibia", "patella", "talus", "calcn", "toes", "humerus", "ulna", "radius", "hand")}
JOINTS = {"femur": ("pelvis", (-0.056276, -0.07849, 0.07726), (0, 0, 0)),
          "tibia": ("femur", (-0.00809, -0.40796, -0.00275), (-0.00808954, -0.0035348, -0.00148474)),
          "talus": ("tibia", (-0.01, -0.4, 0), (0, 0, 0)),
          "calcn": ("talus", (-0.04877, -0.04195, 0.00792), (0, 0, 0))}
TORSO = (-0.1007, 0.0815, 0)


def document(name, kind):
    root = ElementTree.parse(FOLDER / name).getroot()
    assert root.tag == "OpenSimDocument" and root.get("Version") == "40000"
    assert [child.tag for child in root] == [kind]
    return root[0]


def markers():
    """Name -> body and place."""
    out = {}
    for marker in document("walktrack_markers.xml", "MarkerSet").iter("Marker"):
        path = marker.findtext("socket_parent_frame")
        assert path.startswith("/bodyset/") and marker.findtext("fixed") == "true"
        assert marker.get("name") not in out
        out[marker.get("name")] = (path[len("/bodyset/"):], [float(v) for v in marker.findtext("location").split()])
    return out


def read_trc(path):
    lines = path.read_text().split("\n")
    names = [name for name in lines[3].split("\t")[2:] if name]
    rows = {}
    for line in lines[6:]:
        cells = line.split("\t")
        if len(cells) > 2 and cells[2]:
            rows[float(cells[1])] = {name: [float(v) for v in cells[2 + 3 * i:5 + 3 * i]] for i, name in enumerate(names)}
    return lines[2].split("\t")[4], names, rows


def read_mot(path):
    lines = path.read_text().split("\n")
    start = lines.index("endheader") + 1
    names = lines[start].split("\t")
    return [dict(zip(names, map(float, line.split("\t")))) for line in lines[start + 1:] if line]


def turn(axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return {"x": [[1, 0, 0], [0, c, -s], [0, s, c]], "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis]


def product(*matrices):
    out = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    for m in matrices:
        out = [[sum(row[k] * m[k][j] for k in range(3)) for j in range(3)] for row in out]
    return out


def moved(pose, point):
    """Of a pose (turn, place)."""
    return [pose[1][i] + sum(pose[0][i][k] * point[k] for k in range(3)) for i in range(3)]


def distance(a, b):
    return math.dist(a, b)


class Model:
    """The legs and the torso, scaled."""

    def __init__(self, scales):
        self.scales = scales

    def scaled(self, body, point):
        return [value * factor for value, factor in zip(point, self.scales.get(body, (1, 1, 1)))]

    def poses(self, q):
        out = {"pelvis": (product(turn("z", q["pelvis_tilt"]), turn("x", q["pelvis_list"]), turn("y", q["pelvis_rotation"])),
                          [q["pelvis_tx"], q["pelvis_ty"], q["pelvis_tz"]])}
        back = product(turn("z", q["lumbar_extension"]), turn("x", q["lumbar_bending"]), turn("y", q["lumbar_rotation"]))
        out["torso"] = (product(out["pelvis"][0], back), moved(out["pelvis"], self.scaled("pelvis", TORSO)))
        for side, sign in (("r", 1), ("l", -1)):
            bend = {"femur": product(turn("z", q[f"hip_flexion_{side}"]), turn("x", sign * q[f"hip_adduction_{side}"]),
                                     turn("y", sign * q[f"hip_rotation_{side}"])),
                    "tibia": turn("z", -q[f"knee_angle_{side}"]), "talus": turn("z", q[f"ankle_angle_{side}"]),
                    "calcn": turn("z", 0)}
            for name, (parent, there, here) in JOINTS.items():
                above = parent if parent == "pelvis" else f"{parent}_{side}"
                body = f"{name}_{side}"
                mirrored = lambda point: (point[0], point[1], sign * point[2])
                joint = moved(out[above], self.scaled(above, mirrored(there)))
                way = product(out[above][0], bend[name])
                out[body] = (way, moved((way, joint), [-v for v in self.scaled(body, mirrored(here))]))
        return out


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.kept.name) / "result"
        subprocess.run([PROGRAM, "analyse", SOURCE / "data/demo/truth.csv", "-o", cls.folder, "--quiet"], check=True,
                       stdout=subprocess.DEVNULL)
        cls.units, cls.names, cls.rows = read_trc(cls.folder / "joints.trc")
        cls.markers = markers()

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def test_markers_are_those_of_the_trc(self):
        self.assertEqual(self.units, "m")
        self.assertEqual(sorted(self.markers), sorted(self.names))  # the demo's truth has arms
        for body, _ in self.markers.values():
            self.assertIn(body, BODIES)

    def test_left_mirrors_right(self):
        for name, (body, place) in self.markers.items():
            if name.startswith("l"):
                other = self.markers["r" + name[1:]]
                self.assertEqual(other[0], body[:-1] + "r" if body.endswith("_l") else body)
                self.assertEqual(other[1], [place[0], place[1], -place[2] + 0])

    def test_inverse_kinematics_names_markers_and_files(self):
        tool = document("ik_setup.xml", "InverseKinematicsTool")
        tasks = {task.get("name"): task for task in tool.iter("IKMarkerTask")}
        self.assertEqual(sorted(tasks), sorted(self.markers))
        for name, task in tasks.items():
            arm = name[1:] in ("shoulder", "elbow", "wrist")
            self.assertEqual(task.findtext("apply"), "false" if arm else "true", name)
            self.assertGreater(float(task.findtext("weight")), 0)
        self.assertTrue((self.folder / tool.findtext("marker_file")).is_file())
        scaler = document("scale_setup.xml", "ScaleTool").find("ModelScaler")
        self.assertEqual(tool.findtext("model_file"), scaler.findtext("output_model_file"))
        start, end = map(float, tool.findtext("time_range").split())
        self.assertTrue(start <= min(self.rows) and max(self.rows) <= end)
        # What it writes must not replace a file of the result.
        self.assertFalse((self.folder / tool.findtext("output_motion_file")).exists())

    def test_scaling_names_markers_bodies_and_files(self):
        tool = document("scale_setup.xml", "ScaleTool")
        self.assertTrue((FOLDER / tool.findtext("GenericModelMaker/marker_set_file")).is_file())
        scaler = tool.find("ModelScaler")
        self.assertTrue((self.folder / scaler.findtext("marker_file")).is_file())
        start, end = map(float, scaler.findtext("time_range").split())
        self.assertTrue(start <= min(self.rows) and max(self.rows) <= end)
        scaled = []
        for measurement in scaler.iter("Measurement"):
            pairs = [pair.text.split() for pair in measurement.iter("markers")]
            self.assertTrue(pairs)
            for pair in pairs:
                self.assertEqual(len(set(pair)), 2)
                self.assertLessEqual(set(pair), set(self.markers))
            scaled += [(body.get("name"), axis) for body in measurement.iter("BodyScale")
                       for axis in body.findtext("axes").split()]
        self.assertEqual(sorted(scaled), sorted((body, axis) for body in BODIES for axis in "XYZ"))

    def scales(self):
        """Body -> factors, as OpenSim's scale tool computes them: the mean distance of the pairs over the rows by that in
        the unscaled model, upright."""
        model = Model({})
        angles = read_mot(self.folder / "angles.mot")
        upright = model.poses({name: 0 for name in angles[0]})
        at_rest = {name: moved(upright[body], place) for name, (body, place) in self.markers.items() if body in upright}
        out = {}
        for measurement in document("scale_setup.xml", "ScaleTool").iter("Measurement"):
            if measurement.findtext("apply") == "false":
                continue
            factors = []
            for pair in measurement.iter("markers"):
                a, b = pair.text.split()
                seen = sum(distance(row[a], row[b]) for row in self.rows.values()) / len(self.rows)
                factors.append(seen / distance(at_rest[a], at_rest[b]))
            factor = sum(factors) / len(factors)
            self.assertTrue(0.7 < factor < 1.3, f"{measurement.get('name')}: {factor}")
            for body in measurement.iter("BodyScale"):
                for axis in body.findtext("axes").split():
                    out.setdefault(body.get("name"), [1, 1, 1])["XYZ".index(axis)] = factor
        return out

    def test_the_scaled_model_with_our_angles_has_its_markers_where_we_saw_them(self):
        model = Model(self.scales())
        worst = {}
        for q in read_mot(self.folder / "angles.mot"):
            poses = model.poses(q)
            row = self.rows[q["time"]]
            for name, (body, place) in self.markers.items():
                if body in poses and name[1:] != "shoulder":
                    error = distance(moved(poses[body], model.scaled(body, place)), row[name])
                    worst[name] = max(worst.get(name, 0), error)
        self.assertEqual(len(worst), 11)
        for name, error in worst.items():
            self.assertLess(error, 0.03 if name in ("head", "neck", "ltoe", "rtoe") else 0.02, f"{name}: {worst}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
