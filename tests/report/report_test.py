#!/usr/bin/env python3
"""Opens reports in a real browser: they load without complaint, ask nobody for anything, show the
numbers of run.json, and can be used with keys, on a telephone and on paper.

    report_test.py WALKTRACK SOURCE_FOLDER [PICTURES]

With PICTURES, a folder, leaves screenshots there. Exit code 77 (skipped) where there is no Chromium.
"""
import csv
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from browser import Browser, find_chromium  # noqa: E402

READY = "document.documentElement?.dataset.ready === 'true'"
# Few particles and frames: the page is tested, not the tracker.
QUICK = ["--set", "filter.particles=60", "--set", "start.particles=20", "--set", "filter.max_layers=2"]
walktrack, demo, pictures = None, None, None


def run(command, *arguments):
    return subprocess.run([walktrack, command, *map(str, arguments)], capture_output=True, text=True, check=False)


def scene(folder, frames, videos=("side", "front")):
    """The demo's scene, cut to `frames`, in a folder of its own."""
    folder.mkdir(parents=True)
    for file in demo.iterdir():
        (folder / file.name).symlink_to(file)
    text = (demo / "scene.yaml").read_text()
    for camera, video in zip(("side", "front"), videos):
        text = text.replace(f"video: {camera}.mp4", f"video: {video}.mp4")
    (folder / "scene.yaml").unlink()
    # Told where the walk begins, nothing is searched for.
    known = "initial: {position: [-2.5, 0], heading: 0, speed: 1.25, phase: 0.5}" if videos[0] == "side" else ""
    (folder / "scene.yaml").write_text(f"{text}\nlast_frame: {frames - 1}\n{known}\n")
    return folder / "scene.yaml"


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.browser = Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.temporary.cleanup()

    def track(self, scene_file, name, *options):
        out = self.folder / name
        result = run("track", scene_file, "-o", out, *QUICK, *options)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        self.assertIn("report.html", result.stderr)
        return out

    def open(self, page, width=1200, ready=READY):
        browser = self.browser
        browser.problems.clear()
        browser.requests.clear()
        browser.size(width, 900)
        browser.open(page, ready)

    def texts(self, selector):
        return self.browser.value(f"[...document.querySelectorAll({json.dumps(selector)})].map((e) => e.textContent)")

    def check_quiet(self, page):
        """No complaint, and no request except for the page itself and what is inside it."""
        self.assertEqual(self.browser.problems, [])
        for url in self.browser.requests:
            self.assertTrue(url == page.as_uri() or url.startswith(("blob:", "data:")), url)

    def test_shows_what_the_run_found(self):
        out = self.track(scene(self.folder / "scene", 60), "found")
        self.open(out / "report.html")
        record = json.loads((out / "run.json").read_text())
        gait = json.loads((out / "gait.json").read_text())
        self.assertEqual(json.loads(self.browser.value("byId('run-json').textContent")), record)
        origin = self.texts("#origin-table")[0]
        for text in (record["digest"], record["scene"]["sha256"], record["program"]["commit"]):
            self.assertIn(text, origin)
        tiles = self.texts("#key-figures li")
        self.assertTrue(any(t.startswith(f"{record['numbers']['tracked_frames']:.0f} of 60") for t in tiles), tiles)
        speed = gait["summary"]["both"]["speed_m_s"]["value"]
        self.assertTrue(tiles[0].startswith(f"{speed:.2f} m/s"), tiles)
        rows = self.texts("#quality-table tbody tr")
        self.assertEqual(len(rows), len(record["quality"]))
        for row, measure in zip(rows, record["quality"]):
            self.assertTrue(row.startswith(measure["what"]), row)
            self.assertIn(f"{measure['value']:.{measure['digits']}f}".replace("-", "−"), row)
        self.assertEqual(len(self.texts("#gait-tables table:last-of-type tbody tr")) > 0, bool(gait["contacts"]))
        settings = dict(zip(self.texts("#settings tbody th"), self.texts("#settings tbody td:nth-child(2)")))
        self.assertEqual(settings["filter.particles"], "60")
        self.video_and_figure()
        self.follows(out)
        self.keys()
        self.small_and_on_paper("report", range(2, 9))
        self.check_quiet(out / "report.html")
        self.only_its_own_script_runs(out / "report.html")

    def only_its_own_script_runs(self, page):
        """Were data to break out of their element all the same, the page's policy stops them."""
        hostile = page.with_name("hostile.html")
        planted = "<script>document.documentElement.dataset.planted = 'ran'</script><img src=x onerror=\"document.documentElement.dataset.planted = 'ran'\">"
        place = '<script type="application/json" id="data">'
        hostile.write_text(page.read_text().replace(place, planted + place, 1))
        self.open(hostile)
        self.assertIsNone(self.browser.value("document.documentElement.dataset.planted ?? null"))
        self.browser.problems.clear()

    def video_and_figure(self):
        value = self.browser.value
        self.assertEqual(value("document.querySelector('#video video').videoWidth"), 640)
        self.assertEqual(len(self.texts("#strip button")), 5)
        opaque = "[...document.querySelectorAll('#strip canvas')].map((c) => c.getContext('2d').getImageData(9, 9, 1, 1).data[3])"
        self.assertEqual(value(opaque), [255] * 5)
        self.assertEqual(self.texts("#cameras button"), ["side", "front"])
        # The figure is drawn: many pixels of the left leg's blue, whatever its shade.
        blue = """(() => { const c = document.querySelector('#space canvas'), d = document.createElement('canvas');
          d.width = c.width; d.height = c.height; const x = d.getContext('2d'); x.drawImage(c, 0, 0);
          const p = x.getImageData(0, 0, d.width, d.height).data; let n = 0;
          for (let i = 0; i < p.length; i += 4) n += p[i] < 60 && p[i + 2] > 90 && p[i + 2] - p[i] > 60;
          return n; })()"""
        self.assertGreater(value(blue), 200)
        self.assertGreater(len(self.texts("#time-charts canvas")), 3)

    def follows(self, out):
        """With z the video shows a window whose middle is the walker: projected by the calibration, in every second frame."""
        value = self.browser.value
        text = (demo / "side.yaml").read_text()
        number = lambda key: [float(v) for v in re.search(key + r":.*?data: \[(.*?)\]", text, re.S).group(1).split(",")]
        matrix, turn, place = number("camera_matrix"), number("rotation"), number("translation")
        with (out / "joints.csv").open() as file:
            joints = list(csv.DictReader(file))
        self.assertEqual(value("document.querySelector('#video video').style.transform"), "")
        self.browser.key("z", "KeyZ", "z")
        self.assertEqual(self.texts("#zooms button[aria-pressed=true]"), ["Follow"])
        for frame in (0, 20, 40, 59):
            value(f"clock.show({frame})")
            x, y, times = map(float, re.fullmatch(r"translate\((.*)px, (.*)px\) scale\((.*)\)", value(
                "document.querySelector('#video video').style.transform")).groups())
            self.assertGreater(times, 1.2)
            world = [float(joints[frame]["pelvis_" + axis]) for axis in "xyz"]
            seen = [sum(turn[3 * i + k] * world[k] for k in range(3)) + place[i] for i in range(3)]
            u, v = (matrix[i] * seen[i // 4] / seen[2] + matrix[2 + 3 * (i // 4)] for i in (0, 4))
            width, height = value("[byId('video').clientWidth, byId('video').clientHeight]")
            ratio = min(width / 640, height / 480)
            at = [x + times * ((width - 640 * ratio) / 2 + u * ratio), y + times * ((height - 480 * ratio) / 2 + v * ratio)]
            self.assertAlmostEqual(at[0], width / 2, delta=0.15 * width)
            self.assertAlmostEqual(at[1], height / 2, delta=0.15 * height)
        self.browser.key("z", "KeyZ", "z")
        self.assertEqual(value("document.querySelector('#video video').style.transform"), "")

    def saved(self):
        """Name -> text of every file that the page's buttons save; of pictures their first bytes."""
        value = self.browser.value
        value("window.saved = {}; save = (name, content) => { saved[name] = content; }; 0")
        value("document.querySelectorAll('.save').forEach((button) => button.click())")
        value("new Promise((done) => setTimeout(done, 500))")
        return {name: value(f"saved[{json.dumps(name)}].slice(0, {4 if name.endswith('.png') else 10**7}).text()")
                for name in value("Object.keys(saved)")}

    def saves_what_it_shows(self, out):
        """Every table and chart, those that are unfolded later, too."""
        self.browser.value("document.querySelectorAll('details').forEach((each) => each.open = true)")
        self.browser.value("new Promise((done) => setTimeout(done, 300))")
        self.assertEqual(len(self.texts("#more-charts canvas")), 8)
        files = self.saved()
        pictures = [name for name in files if name.endswith(".png")]
        self.assertEqual(len(pictures), self.browser.value("document.querySelectorAll('.chart').length"))
        for name in pictures:
            self.assertEqual(files[name][1:], "PNG", name)
        self.assertEqual(json.loads(files["run.json"]), json.loads((out / "run.json").read_text()))
        rows = lambda name: list(csv.DictReader(files[name].splitlines()))
        summary = json.loads((out / "gait.json").read_text())["summary"]
        gait = {row["mean"]: row for row in rows("gait.csv")}
        self.assertAlmostEqual(float(gait["Walking speed, m/s"]["both"]), summary["both"]["speed_m_s"]["value"], delta=1e-6)
        self.assertEqual(len(rows("contacts.csv")), len(self.texts("#gait-tables h3 + .scroll tbody tr")))
        knee = rows("knee.csv")
        self.assertEqual([row["percent"] for row in knee], [str(k) for k in range(101)])
        self.assertGreater(max(float(row["left mean"]) for row in knee), 50)
        for name in ("norm low", "right stride 1", "right mean"):
            self.assertIn(name, knee[0])
        for name in ("angle_ranges.csv", "settings.csv", "hip_rotation.csv", "pelvis_obliquity.csv", "vertical_ground_reaction.csv"):
            self.assertGreater(len(rows(name)), 3, name)

    def takes_own_norms(self):
        """From files that the reader chooses; what is wrong with one is said, and the others are taken."""
        value = self.browser.value
        files = {"broken.csv": "percent,knee_flexion_low\n0,1\n0,2\n",
                 "lab.csv": "# who: adults of our laboratory\n# 31 people\npercent,knee_flexion_low,knee_flexion_high,hip_adduction_low,hip_adduction_high\n"
                            "0,0,8\n".replace("0,0,8", "0,0,8,-3,3") + "50,10,20,-3,3\n100,0,8,-3,3\n"}
        value(f"""(async () => {{ const chosen = new DataTransfer();
          for (const [name, text] of Object.entries({json.dumps(files)})) chosen.items.add(new File([text], name));
          byId('norm-files').files = chosen.files; await byId('norm-files').onchange(); }})()""")
        self.assertEqual(self.texts("#norm-message"), [
            "broken.csv: row 2 below the header is not a row of numbers with a percent that grows from 0 to 100"])
        self.assertEqual(self.texts("#norm-choice option:checked"), ["adults of our laboratory"])
        captions = self.texts("#cycle-charts figcaption small")
        self.assertIn("adults of our laboratory", captions[1])
        self.assertNotIn("adults", captions[0])  # nothing is said of hips
        self.assertIn("31 people", self.texts("#normal-note")[0])
        self.assertEqual(value("normalAt('knee_flexion_low')[25]"), 5)
        self.assertEqual(len(self.texts("#cycle-charts canvas")), 4)
        value("byId('norm-choice').value = '0'; byId('norm-choice').onchange()")
        self.assertIn("4- to 17-year-olds", self.texts("#cycle-charts figcaption")[0])

    def keys(self):
        value = self.browser.value
        value("clock.show(10)")
        self.browser.key("ArrowRight", "ArrowRight")
        self.assertEqual(value("clock.frame"), 11)
        self.assertIn("frame 11", self.texts("#now")[0])
        self.browser.key(" ", "Space", " ")
        self.assertEqual(self.texts("#play"), ["Pause"])
        # It plays; on a busy machine it may have come round to the beginning when it is looked at.
        value("new Promise((done) => { const watch = setInterval(() => {"
              " if (clock.frame !== 11) { clearInterval(watch); done(); } }, 20); })")
        self.browser.key(" ", "Space", " ")
        self.assertEqual(self.texts("#play"), ["Play"])
        value("clock.show(12)")
        value("byId('scrubber').focus()")
        before = value("clock.frame")
        self.browser.key("ArrowLeft", "ArrowLeft")
        self.assertEqual(value("clock.frame"), before - 1)
        # The video follows to the middle of that frame.
        value("new Promise((done) => setTimeout(done, 300))")
        shown = value("document.querySelector('#video video').currentTime")
        self.assertAlmostEqual(shown, (before - 1 + 0.5) / 30, delta=0.5 / 30)

    def small_and_on_paper(self, name, pages):
        if pictures:
            self.browser.picture(pictures / f"{name}_desk.png")
        paper = self.folder / f"{name}.pdf"
        self.browser.paper(paper)
        self.assertIn(len(re.findall(rb"/Type\s*/Page\b", paper.read_bytes())), pages)
        self.browser.size(390, 844, 2, True)
        self.browser.value("new Promise((done) => setTimeout(done, 300))")
        self.assertLessEqual(self.browser.value("document.documentElement.scrollWidth"), 390)
        if pictures:
            self.browser.size(390, 844, 1, True)  # at 2, a long page is higher than pictures may be
            self.browser.picture(pictures / f"{name}_phone.png")
            shutil.copy(paper, pictures / f"{name}.pdf")

    def test_shows_an_analysed_motion(self):
        """Motion capture has no video, no bands and, here, no zero in its times."""
        lines = (demo / "truth.csv").read_text().splitlines()
        motion = self.folder / "captured.csv"
        motion.write_text("\n".join([lines[0]] + [f"{float(t) + 7:.6f},{rest}" for t, rest in
                                                  (line.split(",", 1) for line in lines[1:])]) + "\n")
        out = self.folder / "analysed"
        result = run("analyse", motion, "-o", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.open(out / "report.html")
        summary = json.loads((out / "gait.json").read_text())["summary"]
        tiles = self.texts("#key-figures li")
        for tile, (column, digits) in zip(tiles, [("speed_m_s", 2), ("step_length_m", 2), ("cadence_steps_per_min", 0)]):
            self.assertTrue(tile.startswith(f"{summary['both'][column]['value']:.{digits}f} "), tile)
        self.assertIn("Analysed", self.texts("#verdict")[0])
        self.assertEqual(self.browser.value("document.querySelector('.video').offsetHeight"), 0)
        self.assertEqual(len(self.texts("#cycle-charts canvas")), 4)
        self.assertIn("4- to 17-year-olds", self.texts("#cycle-charts figcaption")[0])
        self.assertEqual(len(self.texts("#time-charts canvas")), 1)
        self.browser.value("clock.show(15)")
        self.assertIn("frame 15  7.50 s", self.texts("#now")[0])
        self.small_and_on_paper("analysed", range(2, 7))
        self.takes_own_norms()
        self.saves_what_it_shows(out)
        self.check_quiet(out / "report.html")

    def test_batch_overview_leads_to_every_report(self):
        many = self.folder / "many"
        for name, frames in (("first walk", 30), ("broken", 20), ("third", 12)):
            scene(many / name, frames)
        (many / "broken/side.mp4").unlink()
        (many / "broken/side.mp4").write_text("no video")
        out = self.folder / "many_out"
        result = run("batch", many, "-o", out, "--jobs", 1, *QUICK)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.open(out / "batch.html", ready="document.readyState === 'complete'")
        with (out / "summary.csv").open() as file:
            table = list(csv.DictReader(file))
        self.assertEqual(self.texts("tbody th"), [row["sequence"] for row in table])
        self.assertEqual(self.texts("tbody td:nth-child(2)"), [row["state"] + row["reason"] for row in table])
        self.assertLessEqual(self.browser.value("document.querySelector('.scroll').scrollWidth"), 1200)
        states = [row["state"] for row in table]
        self.assertEqual(states.count("failed"), 1)
        for tile in self.texts(".tiles li"):
            count, state = re.fullmatch(r"(\d+)(\w+)", tile).groups()
            self.assertEqual(int(count), states.count(state))
        self.sorts()
        self.fits_on_paper()
        self.small_and_on_paper("batch", (1, 2))
        self.check_quiet(out / "batch.html")
        for row, link in zip(table, self.browser.value("[...document.querySelectorAll('tbody a')].map((a) => a.href)")):
            path = pathlib.Path(urllib.parse.unquote(urllib.parse.urlparse(link).path))
            self.assertEqual(path.exists(), True, link)
            self.assertEqual(path.name == "report.html", row["state"] != "failed", link)

    def test_compares_groups_and_sides(self):
        """Two walks of which the second is slower, then the two sides of the first."""
        lines = (demo / "truth.csv").read_text().splitlines()
        results = []
        for name, slower in (("before", 1), ("after <b>", 1.2)):
            motion = self.folder / "slower.csv"
            motion.write_text("\n".join([lines[0]] + [f"{slower * float(t):.6f},{rest}" for t, rest in
                                                      (line.split(",", 1) for line in lines[1:])]) + "\n")
            results.append(self.folder / name)
            self.assertEqual(run("analyse", motion, "-o", results[-1]).returncode, 0)
        out = self.folder / "compared"
        result = run("compare", *results, "-o", out, "--draws", 200)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.open(out / "compare.html")
        compared = json.loads((out / "compare.json").read_text())
        self.assertEqual(self.texts("h1"), ["before, after <b>"])
        reference, other = compared["comparisons"][0]["samples"]
        rows = self.texts("#parameter-tables tbody tr")
        self.assertEqual(len(rows), len(compared["parameters"]))
        speed = other["parameters"]["speed_m_s"]
        self.assertIn(f"{speed['mean']:.2f} ± {speed['sd']:.2f}, n = {speed['count']}", rows[0])
        self.assertIn(f"−{-speed['difference']:.2f} −{-speed['low']:.2f} to −{-speed['high']:.2f}", rows[0])
        self.assertTrue(rows[0].endswith("differs"), rows[0])
        self.assertEqual(sum(row.endswith("differs") for row in rows),
                         sum(p.get("exceeds", False) for p in other["parameters"].values()))
        self.assertEqual(len(self.texts("#curve-charts canvas")), 8)
        self.assertEqual(self.texts("#sides button"), ["Both sides", "Left side", "Right side"])
        self.browser.value("document.querySelector('#sides button:nth-child(2)').focus()")
        self.browser.key("Enter", "Enter", "\r")
        left = compared["comparisons"][1]["samples"][1]["parameters"]["speed_m_s"]
        self.assertIn(f"n = {left['count']}", self.texts("#parameter-tables tbody tr")[0])
        self.assertNotEqual(left["count"], speed["count"])
        self.small_and_on_paper("compare", range(2, 6))
        self.check_quiet(out / "compare.html")
        sides = self.folder / "sides"
        self.assertEqual(run("compare", results[0], "-o", sides, "--draws", 200).returncode, 0)
        self.open(sides / "compare.html")
        self.assertEqual(self.texts("#parameter-tables thead th")[1:3], ["right", "left"])
        self.assertEqual(self.texts("#sides button"), [])
        self.check_quiet(sides / "compare.html")

    def fits_on_paper(self):
        """On A4 across without its margins, 269 mm, no column is cut off."""
        self.browser.size(1017, 700)
        self.browser.send("Emulation.setEmulatedMedia", media="print")
        widths = self.browser.value("['scrollWidth', 'clientWidth'].map((name) => document.querySelector('.scroll')[name])")
        self.browser.send("Emulation.setEmulatedMedia", media="")
        self.browser.size(1200, 900)
        self.assertLessEqual(widths[0], widths[1])

    def sorts(self):
        """By name down and up again with the keyboard."""
        names = self.texts("tbody th")
        self.browser.value("document.querySelector('thead button').focus()")
        for expected in (sorted(names), sorted(names, reverse=True), sorted(names)):
            self.browser.key("Enter", "Enter", "\r")
            self.assertEqual(self.texts("tbody th"), expected)

    def test_large_videos_are_played_from_beside_the_page(self):
        out = self.track(scene(self.folder / "large", 30), "large_out", "--set", "report.embed_mb=0")
        self.open(out / "report.html")
        self.assertLess((out / "report.html").stat().st_size, 500_000)
        self.assertEqual(self.browser.value("document.querySelector('#video video').videoWidth"), 640)
        self.assertIn("overlay_side.mp4", self.texts("#video-note")[0])

    def test_names_from_outside_stay_text(self):
        hostile = "<img src=x onerror=document.title='owned'> \" ' & </script> \n"
        hostile = hostile.replace("/", "∕")  # no folder has a slash in its name
        out = self.track(scene(self.folder / hostile, 30), "hostile", "--no-overlay")
        self.open(out / "report.html")
        self.assertEqual(self.texts("h1"), [hostile + " / scene.yaml"])
        self.assertEqual(self.browser.value("document.images.length"), 0)
        self.assertNotEqual(self.browser.value("document.title"), "owned")
        self.assertIn("wrote no overlay", self.texts("#video")[0])
        self.check_quiet(out / "report.html")

    def test_a_video_of_nobody_makes_a_page_that_says_so(self):
        out = self.track(scene(self.folder / "empty", 30, ("side_background", "front_background")), "nobody")
        self.open(out / "report.html")
        self.assertIn("Nobody was found walking", self.texts("#verdict")[0])
        self.assertIn("No whole stride", self.texts("#cycle-charts")[0])
        self.check_quiet(out / "report.html")


if __name__ == "__main__":
    if not find_chromium():
        print("SKIPPED: there is no chromium to open the reports in")
        sys.exit(77)
    walktrack, demo = sys.argv[1], pathlib.Path(sys.argv[2]).resolve() / "data/demo"
    pictures = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
    if pictures:
        pictures.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1], verbosity=2)
