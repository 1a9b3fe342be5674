#!/usr/bin/env python3
"""The Python module reads what the program writes.

    walktrack_test.py WALKTRACK SOURCE_FOLDER

With numpy and without it; tables are also read as `pandas.read_csv(file)` does, and curves drawn with matplotlib: where
one of these is not installed its tests are skipped, and say so.
"""
import csv
import importlib
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCE / "apps/python"))
import walktrack  # noqa: E402


def found(name):
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


class WithResult(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.base = pathlib.Path(cls.kept.name)
        cls.folder = cls.base / "results" / "captured"
        # The demo's truth with a gap: rows without a figure are empty in every table.
        rows = (SOURCE / "data/demo/truth.csv").read_text().splitlines()
        columns = rows[0].count(",")
        for at in (40, 41):
            rows[at] = rows[at].split(",")[0] + "," * columns
        motion = cls.base / "motion.csv"
        motion.write_text("\n".join(rows) + "\n")
        subprocess.run([PROGRAM, "analyse", motion, "--mass", "70", "-o", cls.folder, "--quiet"], check=True,
                       stdout=subprocess.DEVNULL)
        shutil.copy(motion, cls.folder / "joints.csv")  # which track leaves, and analyse does not
        cls.result = walktrack.read(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()


class Checks:
    def test_a_column_is_the_files(self):
        with open(self.folder / "angles.csv", newline="") as file:
            cells = [row["knee_angle_l_deg"] for row in csv.DictReader(file)]
        values = self.result.table("angles")["knee_angle_l_deg"]
        self.assertEqual(len(values), len(cells))
        for cell, value in zip(cells, values):
            self.assertTrue(math.isnan(value) if cell == "" else float(cell) == value)
        self.assertEqual(sum(cell == "" for cell in cells), 2)

    def test_joints_have_three_columns(self):
        knee = self.result.joint("lknee")
        self.assertEqual((len(knee), len(knee[0])), (len(self.result.time), 3))
        self.assertEqual(knee[7][2], self.result.table("joints")["lknee_z"][7])
        self.assertEqual(self.result.joints[:3], ["pelvis", "neck", "head"])

    def test_words_stay_words(self):
        self.assertLessEqual(set(self.result.table("gait")["side"]), {"left", "right"})

    def test_parameters_have_their_bands(self):
        rows = {(row["parameter"], row["side"]): row for row in self.result.parameters()}
        speed = rows["speed_m_s", "both"]
        self.assertAlmostEqual(speed["value"], 1.25, delta=0.05)
        self.assertEqual(speed["value"], self.result.parameter("speed_m_s"))
        self.assertIn(("step_time_percent", "symmetry"), rows)

    def test_cycles_go_from_strike_to_strike(self):
        strikes = self.result.strikes("right")
        cycles = self.result.cycles("knee_angle_r_deg", "right")
        self.assertGreaterEqual(len(cycles), 1)
        self.assertEqual(len(cycles[0]), 101)
        # A knee bends twice a cycle, and most in swing.
        widest = max(range(101), key=lambda k: cycles[0][k])
        self.assertTrue(60 < widest < 90, widest)
        self.assertLess(len(cycles), len(strikes))

    def test_the_runs_verdict(self):
        self.assertTrue(self.result.complete)
        failed = [check["name"] for check in self.result.run["quality"] if not check["passed"]]
        self.assertEqual(self.result.failed_checks, failed)
        self.assertEqual(self.result.passed, not failed)
        self.assertIn("analysed", repr(self.result))

    def test_results_below_a_folder(self):
        self.assertEqual(list(walktrack.read_all(self.base)), ["results/captured"])

    def test_what_is_no_result_says_so(self):
        def message(call):
            with self.assertRaises(walktrack.ResultError) as raised:
                call()
            return str(raised.exception)

        self.assertIn("there is no run.json", message(lambda: walktrack.read(self.base)))
        self.assertIn("allowed: joints, uncertainty", message(lambda: self.result.table("forces")))
        self.assertIn("allowed: pelvis, neck", message(lambda: self.result.joint("elbow")))
        self.assertIn("found 'wrist'", message(lambda: self.result.cycles("wrist", "left")))
        broken = self.base / "broken"
        broken.mkdir()
        (broken / "run.partial.json").write_text(json.dumps({"status": "stopped", "quality": []}))
        partial = walktrack.read(broken)
        self.assertFalse(partial.passed)
        self.assertIn("there is no such file", message(lambda: partial.table("angles")))
        (broken / "angles.csv").write_text("t,a\n1\n")
        self.assertIn("rows as long as it", message(lambda: partial.table("angles")))
        (broken / "run.partial.json").write_text("{")
        self.assertIn("run.partial.json", message(lambda: walktrack.read(broken)))

    @unittest.skipUnless(found("matplotlib"), "matplotlib is not installed")
    def test_curves_are_drawn_with_their_bands(self):
        found("matplotlib").use("Agg")
        axes = self.result.plot("l_grf_z_n", label="left")
        self.assertEqual(axes.get_ylabel(), "l_grf_z_n")
        self.assertEqual(len(axes.lines), 1)
        again = self.result.plot_cycle("knee_angle_l_deg", "left", color="black")
        self.assertEqual(len(again.lines[0].get_xdata()), 101)
        drawn = self.base / "curve.png"
        again.figure.savefig(drawn)
        self.assertGreater(drawn.stat().st_size, 5000)


@unittest.skipUnless(walktrack.numpy, "numpy is not installed")
class WithNumpy(Checks, WithResult):
    def test_columns_are_arrays(self):
        self.assertEqual(self.result.joint("head").shape, (len(self.result.time), 3))
        self.assertTrue(walktrack.numpy.isnan(self.result.table("kinetics")["com_x_m"]).any())


class WithoutNumpy(Checks, WithResult):
    @classmethod
    def setUpClass(cls):
        cls.numpy, walktrack.numpy = walktrack.numpy, None
        super().setUpClass()

    @classmethod
    def tearDownClass(cls):
        walktrack.numpy = cls.numpy
        super().tearDownClass()

    def test_columns_are_lists(self):
        self.assertIsInstance(self.result.joint("head"), list)


class Tables(WithResult):
    """Every CSV is a header and rows of its length, without comments before it."""

    def tables(self):
        paths = sorted(self.folder.glob("*.csv"))
        self.assertGreaterEqual(len(paths), 3)
        return paths

    def test_headers_are_first(self):
        for path in self.tables():
            with open(path, newline="") as file:
                rows = list(csv.reader(file))
            self.assertRegex(rows[0][0], "^[a-z]")
            self.assertEqual(len(set(rows[0])), len(rows[0]), path)
            self.assertTrue(all(len(row) == len(rows[0]) for row in rows), path)

    @unittest.skipUnless(found("pandas"), "pandas is not installed")
    def test_pandas_reads_them_without_arguments(self):
        pandas = found("pandas")
        for path in self.tables():
            frame = pandas.read_csv(path)
            words = [name for name in frame.columns if not pandas.api.types.is_numeric_dtype(frame[name])]
            self.assertEqual(words, ["side"] if path.name == "gait.csv" else [], path)
            self.assertEqual(list(frame.columns), list(self.result.table(path.stem)))
        self.assertEqual(self.result.frame("angles").shape[0], len(self.result.time))


if __name__ == "__main__":
    for name in ("numpy", "pandas", "matplotlib"):
        if not found(name):
            print(f"SKIPPED: what is tried with {name}, which is not installed")
    unittest.main(argv=sys.argv[:1])
