"""Results of walktrack as arrays, tables and curves.

    import walktrack
    result = walktrack.read("out/demo")
    result.passed                                # did every quality check pass?
    result.joint("lknee")                        # metres, one row for each frame, NaN where nobody was tracked
    result.table("angles")["knee_angle_l_deg"]   # a column of angles.csv
    result.parameters()                          # speed, cadence, ... with 5-95 % bands
    result.cycles("knee_angle_l_deg", "left")    # strides x 101 over the gait cycle
    result.frame("kinetics")                     # a pandas.DataFrame
    result.plot("knee_angle_l_deg")              # matplotlib, with its band
    walktrack.read_all("out/batch")              # every result below a folder

Works with Python's standard library alone; arrays are numpy's where numpy is installed, else lists. pandas and
matplotlib are only needed by frame() and by plot(), plot_cycle(). What every file and column holds is in the guide's
formats.md; units are in the columns' names, lengths in metres, times in seconds.
"""
import bisect
import csv
import json
import math
import pathlib

try:
    import numpy
except ImportError:
    numpy = None

TABLES = ("joints", "uncertainty", "angles", "kinetics", "gait")
CYCLE = 101  # samples of a gait cycle, 0 to 100 %


class ResultError(ValueError):
    """A folder or file that is no result of walktrack."""


def _array(values):
    return values if numpy is None else numpy.array(values, dtype=float)


def _number(cell):
    return float(cell) if cell else math.nan


def _columns(path):
    """Column -> values of a CSV file: floats, NaN for empty cells; words (the side in gait.csv) as text."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(line for line in file if not line.startswith("#")))
    except FileNotFoundError:
        raise ResultError(f"{path}: there is no such file") from None
    if not rows or any(len(row) != len(rows[0]) for row in rows):
        raise ResultError(f"{path}: this is no table with a header and rows as long as it")
    out = {}
    for index, name in enumerate(rows[0]):
        cells = [row[index] for row in rows[1:]]
        try:
            out[name] = _array([_number(cell) for cell in cells])
        except ValueError:
            out[name] = cells
    return out


def _json(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except json.JSONDecodeError as error:
        raise ResultError(f"{path}: {error}") from None


def _at(times, values, time):
    """The line through neighbouring samples at a time; NaN outside them and beside an unknown one."""
    after = bisect.bisect_left(times, time - 1e-9)
    if after == len(times) or (after == 0 and times[0] > time + 1e-9):
        return math.nan
    if times[after] <= time + 1e-9:
        return float(values[after])
    share = (time - times[after - 1]) / (times[after] - times[after - 1])
    return float((1 - share) * values[after - 1] + share * values[after])


class Result:
    """One result folder of track or analyse. Files are read when they are asked for, and once."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        whole, part = self.folder / "run.json", self.folder / "run.partial.json"
        self.complete = whole.is_file()
        if not self.complete and not part.is_file():
            raise ResultError(f"{self.folder}: there is no run.json; this is no result of walktrack")
        self.run = _json(whole if self.complete else part)
        self._tables = {}

    def __repr__(self):
        return f"walktrack.Result({str(self.folder)!r}, {self.run.get('status')})"

    @property
    def quality(self):
        """The quality checks, as run.json has them: a list of objects with `name`, `value`, `gate`, `passed` and others."""
        return self.run["quality"]

    @property
    def passed(self):
        """Whether the result is complete and every quality check passed."""
        return self.complete and not self.failed_checks

    @property
    def failed_checks(self):
        return [check["name"] for check in self.quality if not check["passed"]]

    def table(self, name):
        """Column -> values of joints.csv, uncertainty.csv, angles.csv, kinetics.csv or gait.csv."""
        if name not in TABLES:
            raise ResultError(f"found '{name}', allowed: {', '.join(TABLES)}")
        if name not in self._tables:
            self._tables[name] = _columns(self.folder / f"{name}.csv")
        return self._tables[name]

    def frame(self, name):
        """The same as a pandas.DataFrame."""
        import pandas

        return pandas.DataFrame(self.table(name))

    @property
    def time(self):
        """Times of the frames, s."""
        return self.table("angles")["t"]

    @property
    def joints(self):
        """The names of the joints in joints.csv, which track writes and analyse does not."""
        return [name[:-2] for name in self.table("joints") if name.endswith("_x")]

    def joint(self, name):
        """Positions of a joint: one row for each frame, columns x, y, z, metres, in the calibration's axes."""
        if name not in self.joints:
            raise ResultError(f"found '{name}', allowed: {', '.join(self.joints)}")
        columns = [self.table("joints")[f"{name}_{axis}"] for axis in "xyz"]
        return [list(row) for row in zip(*columns)] if numpy is None else numpy.stack(columns, axis=1)

    @property
    def gait(self):
        """gait.json."""
        if "gait.json" not in self._tables:
            self._tables["gait.json"] = _json(self.folder / "gait.json")
        return self._tables["gait.json"]

    def parameters(self):
        """Gait parameters as a list of {parameter, side, value, p05, p95}; None where nothing is known."""
        summary = self.gait["summary"]
        return [{"parameter": name, "side": side, **band} for side in ("both", "left", "right", "symmetry")
                for name, band in summary[side].items()]

    def parameter(self, name, side="both"):
        """Value of one gait parameter, None where it is not known."""
        return self.gait["summary"][side][name]["value"]

    def strikes(self, side):
        """Times of a foot's strikes, s."""
        return [event["time_s"]["value"] for event in self.gait["events"]
                if event["event"] == "foot_strike" and event["side"] == side]

    def _series(self, column):
        for name in ("angles", "kinetics", "joints"):
            if (self.folder / f"{name}.csv").is_file() and column in self.table(name):
                return self.table(name)
        raise ResultError(f"found '{column}', allowed: a column of angles.csv, kinetics.csv or joints.csv")

    def cycles(self, column, side):
        """A column over the gait cycles of a foot, from strike to strike: one row for each stride, 101 samples. Strides
        with an unknown sample are left out."""
        table, strikes = self._series(column), self.strikes(side)
        out = []
        for start, end in zip(strikes, strikes[1:]):
            row = [_at(table["t"], table[column], start + (end - start) * k / (CYCLE - 1)) for k in range(CYCLE)]
            if not any(math.isnan(value) for value in row):
                out.append(row)
        return _array(out)

    def plot(self, column, axes=None, **line):
        """Draws a column over time with its 5-95 % band, and returns the axes."""
        table = self._series(column)
        axes = axes or _axes("time, s", column)
        drawn, = axes.plot(table["t"], table[column], **line)
        low, high = table.get(column + "_p05"), table.get(column + "_p95")
        if low is not None and not all(math.isnan(value) for value in low):
            axes.fill_between(table["t"], low, high, alpha=0.25, color=drawn.get_color(), linewidth=0)
        return axes

    def plot_cycle(self, column, side, axes=None, **line):
        """Draws the mean over the gait cycles of a foot, and one standard deviation where there are several."""
        rows = [list(row) for row in self.cycles(column, side)]
        if not rows:
            raise ResultError(f"{self.folder}: no whole stride of the {side} foot has '{column}'")
        axes = axes or _axes("gait cycle, %", column)
        means = [math.fsum(values) / len(rows) for values in zip(*rows)]
        drawn, = axes.plot(range(CYCLE), means, **line)
        if len(rows) > 1:
            spread = [math.sqrt(math.fsum((v - mean) ** 2 for v in values) / (len(rows) - 1))
                      for values, mean in zip(zip(*rows), means)]
            axes.fill_between(range(CYCLE), [m - s for m, s in zip(means, spread)],
                              [m + s for m, s in zip(means, spread)], alpha=0.25, color=drawn.get_color(), linewidth=0)
        return axes


def _axes(below, beside):
    from matplotlib import pyplot

    axes = pyplot.subplots()[1]
    axes.set_xlabel(below)
    axes.set_ylabel(beside)
    return axes


def read(folder):
    """The result in a folder; ResultError if there is none."""
    return Result(folder)


def read_all(folder):
    """Folder (relative) -> result, of every complete one below a folder, as `walktrack batch` leaves them."""
    base = pathlib.Path(folder)
    return {str(path.parent.relative_to(base)): Result(path.parent) for path in sorted(base.rglob("run.json"))
            if (path.parent / "gait.json").is_file()}
