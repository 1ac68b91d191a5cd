"""Studies: the same rows, whoever works them out."""

import concurrent.futures
import multiprocessing
import os
import shutil
import signal
import subprocess
import sys
import time
from math import pi
from pathlib import Path

import numpy as np
import pytest

import linkwork
from linkwork import executors

SHIPPED = Path(__file__).parents[2] / "mechanisms"
VARY = {"l2": (1.5, 5), "theta1": ("0 deg", "360 deg")}


@pytest.fixture
def four_bar():
    return linkwork.load(SHIPPED / "four_bar.ron")


def same(a, b):
    assert list(a) == list(b)
    for name in a:
        assert a[name].tobytes() == b[name].tobytes(), name


def test_rows_are_what_single_questions_answer(four_bar):
    rows = linkwork.study(four_bar, VARY, ["phi1", "assemblies", "reach=hypot(left.x, left.y)"], samples=40)
    assert list(rows) == ["row", "l2", "theta1", "assembled", "assemblies", "phi1", "reach"]
    p = four_bar.parameters
    x, y = p["l0"] - p["l1"] * np.cos(rows["theta1"]), p["l1"] * np.sin(rows["theta1"])
    reach = np.hypot(x, y)
    closes = (reach < rows["l2"] + p["l3"]) & (reach > np.abs(rows["l2"] - p["l3"]))
    assert closes.any() and (~closes).any()
    np.testing.assert_array_equal(rows["assembled"], closes)
    np.testing.assert_array_equal(rows["assemblies"], 2 * closes)
    assert np.isnan(rows["phi1"][~closes]).all()
    for i in np.flatnonzero(closes)[:5]:
        one = four_bar.with_parameters(l2=rows["l2"][i]).solve(theta1=rows["theta1"][i])
        assert one.joints.phi1 == pytest.approx(rows["phi1"][i], abs=1e-9)
        left = one.frames["left"].position
        assert np.hypot(left[0], left[1]) == pytest.approx(rows["reach"][i], abs=1e-9)


def test_points_are_those_of_the_literature(four_bar):
    qmc = pytest.importorskip("scipy.stats").qmc
    rows = linkwork.study(four_bar, {"l1": (0, 1), "l2": (0, 1), "l3": (0, 1)}, samples=255)
    sobol = qmc.Sobol(3, scramble=False).random(256)[1:]
    found = np.column_stack([rows[name] for name in ("l1", "l2", "l3")])
    np.testing.assert_array_equal(found, sobol)
    # all ten dimensions there are
    lines = linkwork.load(SHIPPED / "stewart_gough_6sps.ron")
    names = [name for name, joint in lines.joints.items() if joint.driven]
    rows = linkwork.study(lines, {name: (1.2, 1.3) for name in names}, samples=15)
    sobol = qmc.scale(qmc.Sobol(len(names), scramble=False).random(16)[1:], [1.2] * 6, [1.3] * 6)
    np.testing.assert_allclose(np.column_stack([rows[name] for name in names]), sobol, rtol=1e-14)
    latin = linkwork.study(four_bar, {"l1": (0, 1), "l2": (0, 1)}, samples=50, latin=True, seed=3)
    for name in ("l1", "l2"):
        assert sorted((latin[name] * 50).astype(int)) == list(range(50))
    other = linkwork.study(four_bar, {"l1": (0, 1), "l2": (0, 1)}, samples=50, latin=True, seed=4)
    assert (other["l1"] != latin["l1"]).any()


def test_rates_are_those_that_are_given(four_bar):
    rows = linkwork.study(four_bar, {"theta1": (0.5, 1.0)}, "velocity:phi1, transmission", grid=3, rate={"theta1": 2.0})
    for i in range(3):
        step = 1e-6
        ends = [four_bar.solve(theta1=rows["theta1"][i] + s, guess={"phi1": 2.2}).joints.phi1 for s in (-step, step)]
        assert rows["velocity:phi1"][i] == pytest.approx((ends[1] - ends[0]) / step, abs=1e-6)
    with pytest.raises(linkwork.QuestionError, match="velocity:phi1"):
        linkwork.study(four_bar, {"theta1": (0.5, 1.0)}, "velocity:phi1", grid=3)


@pytest.mark.parametrize("shards", [1, 2, 7, 64])
def test_bytes_do_not_depend_on_the_shards(four_bar, shards):
    for points in ({"samples": 50}, {"samples": 50, "latin": True}, {"grid": [7, 5]}):
        whole = linkwork.study(four_bar, VARY, "phi1, transmission", **points)
        same(whole, linkwork.study(four_bar, VARY, "phi1, transmission", shards=shards, **points))
    given = np.column_stack([np.linspace(3, 5, 23), np.linspace(0, pi, 23)])
    whole = linkwork.study(four_bar, list(VARY), "phi1", samples=given)
    assert (whole["l2"] == given[:, 0]).all()
    same(whole, linkwork.study(four_bar, list(VARY), "phi1", samples=given, shards=shards))


@pytest.mark.parametrize("executor", [concurrent.futures.ThreadPoolExecutor, concurrent.futures.ProcessPoolExecutor])
def test_bytes_do_not_depend_on_who_works(four_bar, executor):
    whole = linkwork.study(four_bar, VARY, "phi1, assemblies", samples=60)
    options = {"mp_context": multiprocessing.get_context("spawn")} if "Process" in executor.__name__ else {}
    with executor(2, **options) as pool:
        same(whole, linkwork.study(four_bar, VARY, "phi1, assemblies", samples=60, executor=pool, shards=9))


def test_the_command_line_works_out_the_same_bytes(tmp_path):
    options = ["--vary", "l2=1.5..5", "--vary", "theta1=0deg..360deg", "--samples", "50", "--quantity", "phi1"]

    def study(*more):
        command = ["linkwork", "study", SHIPPED / "four_bar.ron", *options, *more]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True).stdout

    whole = study()
    assert len(whole.splitlines()) == 51
    for shards in (2, 9):
        parts = [tmp_path / f"{shards}-{i}.csv" for i in range(1, shards + 1)]
        for i, part in enumerate(parts):
            study("--shard", f"{i + 1}/{shards}", "-o", part)
        merge = ["linkwork", "merge", *map(str, reversed(parts))]
        assert subprocess.run(merge, capture_output=True, text=True, check=True).stdout == whole
        broken = subprocess.run([*merge[:2], *merge[3:]], capture_output=True, text=True, check=False)
        assert broken.returncode == 2 and f"shard {shards} of {shards} is missing" in broken.stderr


def test_finished_shards_are_not_worked_out_again(four_bar, tmp_path):
    whole = linkwork.study(four_bar, VARY, "phi1", samples=40, shards=4, keep=tmp_path)
    kept = sorted(tmp_path.iterdir())
    assert len(kept) == 4
    before = [file.stat().st_mtime_ns for file in kept]
    kept[2].unlink()
    same(whole, linkwork.study(four_bar, VARY, "phi1", samples=40, shards=4, keep=tmp_path))
    after = [file.stat().st_mtime_ns for file in sorted(tmp_path.iterdir())]
    assert [a == b for a, b in zip(before, after)] == [True, True, False, True]
    # another question has other shards
    linkwork.study(four_bar, VARY, "phi1", samples=41, shards=4, keep=tmp_path)
    assert len(list(tmp_path.iterdir())) == 8


def test_what_is_wrong_is_said(four_bar):
    for vary, points, words in [
        ({"l9": (0, 1)}, {"samples": 3}, "l9"),
        ({"l2": (0, 1)}, {"grid": [3, 3]}, "2 numbers of nodes are given for 1"),
        ({"l2": (0, 1)}, {"samples": 0}, "one point or more"),
        ({}, {"samples": 3}, "nothing is varied"),
    ]:
        with pytest.raises(linkwork.QuestionError, match=words):
            linkwork.study(four_bar, vary, "phi1", **points)
    with pytest.raises(linkwork.QuestionError, match="phj1"):
        linkwork.study(four_bar, {"l2": (3, 4)}, "phj1", samples=3)
    with pytest.raises(TypeError, match="samples or a grid"):
        linkwork.study(four_bar, {"l2": (0, 1)}, "phi1")


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"vary": 3}, "vary"),
        ({"vary": {"l2": 3}}, "vary"),
        ({"vary": {"l2": (1, None)}}, "vary"),
        ({"quantities": 3}, "quantities"),
        ({"samples": 2.5}, "samples"),
        ({"samples": True}, "samples"),
        ({"samples": 10**30}, "samples"),
        ({"vary": ["l2"], "samples": [3.0, None]}, "samples"),
        ({"vary": ["l2"], "samples": np.ma.array([3.0, 4.0], mask=[0, 1])}, "samples"),
        ({"latin": "yes"}, "latin"),
        ({"samples": None, "grid": "ten"}, "grid"),
        ({"deviate": 3}, "deviate"),
        ({"deviate": {"l1": None}}, "deviate"),
        ({"executor": 3}, "executor"),
        ({"shards": "two"}, "shards"),
        ({"keep": 3}, "keep"),
        ({"progress": 3}, "progress"),
    ],
)
def test_what_is_of_the_wrong_kind_is_named(four_bar, given, named):
    with pytest.raises((TypeError, ValueError), match=f"^`{named}"):
        linkwork.study(four_bar, **{"vary": {"l2": (3, 4)}, "quantities": "phi1", "samples": 4, **given})


def test_paths_and_mechanisms_are_checked(four_bar):
    rows = linkwork.study(four_bar, VARY, "phi1", samples=4)
    for ask, named in [
        (lambda: linkwork.study_into(3, four_bar, VARY, samples=4), "path"),
        (lambda: linkwork.study("four_bar.ron", VARY, samples=4), "m"),
        (lambda: rows.write(3), "path"),
        (lambda: rows.regions("4"), "grid"),
    ]:
        with pytest.raises(TypeError, match=f"^`{named}`"):
            ask()


def test_an_interrupted_file_says_what_is_kept(four_bar, tmp_path):
    """What is finished is kept in the folder and not worked out again; without a folder nothing is, as is said."""
    whole = tmp_path / "whole.csv"
    linkwork.study_into(whole, four_bar, VARY, "phi1", samples=40, shards=4)

    def stop(_, done, __):
        if done == 2:
            raise KeyboardInterrupt

    file, keep = tmp_path / "rows.csv", tmp_path / "kept"
    asked = {"samples": 40, "shards": 4, "progress": stop}
    with pytest.raises(KeyboardInterrupt, match="nothing is written to .*rows.csv; keep=FOLDER keeps"):
        linkwork.study_into(file, four_bar, VARY, "phi1", **asked)
    with pytest.raises(KeyboardInterrupt, match="finished shards are in .*kept"):
        linkwork.study_into(file, four_bar, VARY, "phi1", **asked, keep=keep)
    assert not file.exists()
    before = {kept: kept.stat().st_mtime_ns for kept in keep.iterdir()}
    assert len(before) == 2
    linkwork.study_into(file, four_bar, VARY, "phi1", samples=40, shards=4, keep=keep)
    assert file.read_bytes() == whole.read_bytes()
    assert before.items() <= {kept: kept.stat().st_mtime_ns for kept in keep.iterdir()}.items()


def test_a_shard_is_read_by_other_readers(tmp_path):
    """Its first line is a comment."""
    pandas = pytest.importorskip("pandas")
    file = tmp_path / "shard.csv"
    options = ["--vary", "l2=3..5", "--samples", "9", "--quantity", "phi1", "--shard", "2/2", "-o", str(file)]
    subprocess.run(["linkwork", "study", str(SHIPPED / "four_bar.ron"), *options], check=True)
    rows = pandas.read_csv(file, comment="#")
    assert list(rows.columns) == ["row of 9", "l2", "assembled", "phi1 (rad)"]
    assert list(rows["row of 9"]) == [4, 5, 6, 7, 8]
    assert np.genfromtxt(file, delimiter=",", skip_header=2).shape == (5, 4)


def test_rows_in_a_file_are_those_in_memory(four_bar, tmp_path):
    asked = (four_bar, VARY, "phi1, velocity:left.x", 200)
    whole = linkwork.study(*asked[:3], samples=asked[3], rate={"theta1": 1.0})
    assert np.isnan(whole["phi1"]).any()
    assert [whole.units[name] for name in ("theta1", "phi1", "velocity:left.x")] == ["rad", "rad", "m/s"]
    written = {}
    for shards in (1, 3, 9):
        file = tmp_path / f"{shards}.csv"
        linkwork.study_into(file, *asked[:3], samples=asked[3], rate={"theta1": 1.0}, shards=shards)
        written[shards] = file.read_bytes()
    options = ["--vary", "l2=1.5..5", "--vary", f"theta1=0..{2 * pi!r}", "--samples", "200", "--rate", "theta1=1"]
    command = ["linkwork", "study", str(SHIPPED / "four_bar.ron"), *options, "--quantity", "phi1, velocity:left.x"]
    assert set(written.values()) == {subprocess.run(command, capture_output=True, check=True).stdout}
    whole.write(tmp_path / "again.csv")
    assert (tmp_path / "again.csv").read_bytes() == written[1]
    with pytest.raises(ValueError, match="does not say how"):
        whole.write(tmp_path / "rows.xls")
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".csv"] * 4


@pytest.mark.parametrize("suffix", [".parquet", ".arrow"])
def test_rows_go_to_parquet_and_arrow(four_bar, tmp_path, suffix):
    pa = pytest.importorskip("pyarrow")
    pq = pytest.importorskip("pyarrow.parquet")
    whole = linkwork.study(four_bar, VARY, "phi1", samples=100)
    file = tmp_path / f"rows{suffix}"
    linkwork.study_into(file, four_bar, VARY, "phi1", samples=100, shards=7)
    table = pq.read_table(file) if suffix == ".parquet" else pa.ipc.open_file(file).read_all()
    assert table.column_names == list(whole) and table.schema.field("phi1").metadata == {b"unit": b"rad"}
    same(whole, {name: table[name].to_numpy().astype(float) for name in whole})
    assert table["phi1"].null_count == np.isnan(whole["phi1"]).sum() > 0
    before = file.read_bytes()
    linkwork.study_into(file, four_bar, VARY, "phi1", samples=100, shards=7)
    assert file.read_bytes() == before


def test_tolerances_spread_as_the_derivatives_say(four_bar):
    """Small independent deviations: the variance of the answer is the sum of the squares of derivative times deviation
    (first-order law of error propagation)."""
    deviations = {"l1": 1e-4, "l2": 2e-4, "l3": 1e-4, "theta1": 1e-4}
    held = {"theta1": 1.0}
    for latin in (False, True):
        rows = linkwork.study(four_bar, (), "phi1", deviate=deviations, samples=4096, latin=latin, **held)
        spread = rows.spread()
        assert spread["l2"].mean == pytest.approx(four_bar.parameters["l2"], abs=1e-5)
        assert spread["l2"].deviation == pytest.approx(2e-4, rel=0.02)
        nominal = four_bar.solve(theta1=1.0).joints.phi1
        variance, step = 0.0, 1e-6
        for name, deviation in deviations.items():
            ends = []
            for sign in (-1, 1):
                if name == "theta1":
                    ends.append(four_bar.solve(theta1=1.0 + sign * step).joints.phi1)
                else:
                    changed = four_bar.with_parameters(**{name: four_bar.parameters[name] + sign * step})
                    ends.append(changed.solve(theta1=1.0).joints.phi1)
            variance += ((ends[1] - ends[0]) / (2 * step) * deviation) ** 2
        assert spread["phi1"].deviation == pytest.approx(variance**0.5, rel=0.03)
        assert spread["phi1"].mean == pytest.approx(nominal, abs=1e-5)
        assert spread["assembled"].mean == 1.0 and spread["phi1"].rows == 4096
    with pytest.raises(linkwork.QuestionError, match="no ends for a grid"):
        linkwork.study(four_bar, {"l1": (1, 2)}, "phi1", deviate={"l2": 1e-3}, grid=[3, 3])
    with pytest.raises(linkwork.QuestionError, match="varied twice"):
        linkwork.study(four_bar, {"l2": (1, 2)}, "phi1", deviate={"l2": 1e-3}, samples=3)


def test_the_command_line_says_how_rows_are_spread(four_bar, tmp_path):
    options = ["--deviate", "l2=0.001", "--deviate", "theta1=0.1deg", "--samples", "100", "--quantity", "phi1"]
    command = ["linkwork", "study", str(SHIPPED / "four_bar.ron"), *options]
    lines = subprocess.run([*command, "--spread"], capture_output=True, text=True, check=True).stdout.splitlines()
    rows = linkwork.study(four_bar, (), "phi1", deviate={"l2": 0.001, "theta1": "0.1 deg"}, samples=100)
    figures = {line.split(",")[0]: list(map(float, line.split(",")[1:])) for line in lines[1:]}
    for name, spread in rows.spread().items():
        unit = f" ({rows.units[name]})" if rows.units[name] else ""
        assert figures[name + unit] == pytest.approx(list(spread.to_dict().values()), rel=1e-12, abs=1e-15)
    parts = [str(tmp_path / f"{i}.csv") for i in (1, 2)]
    for i, part in enumerate(parts):
        subprocess.run([*command, "--shard", f"{i + 1}/2", "-o", part], check=True)
    merged = subprocess.run(["linkwork", "merge", "--spread", *parts], capture_output=True, text=True, check=True)
    assert merged.stdout.splitlines() == lines


def test_maps_are_joined_across_the_seams_of_shards(four_bar, tmp_path):
    """Where l2 + l3 and |l2 - l3| bound the diagonal of the crank: of a row the lengths that close are an interval."""
    grid = [9, 40]
    command = [
        "linkwork",
        "study",
        str(SHIPPED / "four_bar.ron"),
        "--vary",
        "theta1=0deg..180deg",
        "--vary",
        "l2=0..12",
    ]
    parts = [str(tmp_path / f"{i}.csv") for i in range(1, 6)]
    for i, part in enumerate(parts):
        subprocess.run([*command, "--grid", "9,40", "--shard", f"{i + 1}/5", "-o", part], check=True)
    merge = ["linkwork", "merge", "--regions", "9,40", *parts]
    lines = subprocess.run(merge, capture_output=True, text=True, check=True).stdout.splitlines()
    found = np.array([int(line.split(",")[-1] or 0) for line in lines[1:]])
    rows = linkwork.study(four_bar, {"theta1": (0, "180 deg"), "l2": (0, 12)}, grid=grid)
    np.testing.assert_array_equal(rows.regions(grid), found)
    assert set(found) == {0, 1} and ((found > 0) == rows["assembled"]).all()
    # the seam between two halves of the turn, left open
    there = rows["assembled"].reshape(grid).copy()
    there[4] = 0
    apart = linkwork.Study({**rows, "assembled": there.ravel()})
    assert set(apart.regions(grid)) == {0, 1, 2}
    with pytest.raises(ValueError, match="not those of this grid"):
        rows.regions([9, 41])


def test_progress_counts_shards_also_those_that_are_kept(four_bar, tmp_path):
    counts = []
    options = {"keep": tmp_path, "progress": lambda _, done, of: counts.append((done, of))}
    for _ in range(2):
        counts.clear()
        linkwork.study(four_bar, VARY, "phi1", samples=20, shards=4, **options)
        assert counts == [(1, 4), (2, 4), (3, 4), (4, 4)]


QUESTION = "phi1, transmission, assemblies"


def works_out_the_same(four_bar, executor, kill, **shards):
    """The rows of a serial run, and again while a worker is killed in the middle."""
    whole = linkwork.study(four_bar, VARY, QUESTION, samples=900)
    same(whole, linkwork.study(four_bar, VARY, QUESTION, executor=executor, samples=900, **shards))
    with concurrent.futures.ThreadPoolExecutor(1) as aside:
        # another question about it, so that the cluster has no results of it yet
        more = f"{QUESTION}, phi2"
        asked = aside.submit(linkwork.study, four_bar, VARY, more, executor=executor, samples=900, **shards)
        time.sleep(0.3)
        assert not asked.done()
        kill()
        again = asked.result(timeout=300)
    again.pop("phi2")
    same(whole, again)


def test_a_cluster_of_dask_works_out_the_same_also_when_a_worker_dies(four_bar):
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        worker = next(iter(client.run(os.getpid).values()))
        works_out_the_same(four_bar, client.get_executor(), lambda: os.kill(worker, signal.SIGKILL))


def children(named):
    """Processes below this one whose command has this name in it."""
    found = subprocess.run(["ps", "-eww", "-o", "pid=,ppid=,args="], capture_output=True, text=True, check=True).stdout
    listed = [line.split(None, 2) for line in found.splitlines()]
    below = {os.getpid()}
    for _ in range(8):
        below |= {int(pid) for pid, parent, *_ in listed if int(parent) in below}
    return [int(pid) for pid, _, *args in listed if int(pid) in below and args and named in args[0]]


def test_ray_works_out_the_same_also_when_a_worker_dies(four_bar):
    ray = pytest.importorskip("ray")
    ray.init(num_cpus=2, include_dashboard=False, configure_logging=False)
    try:

        def kill():
            workers = children("ray::_shard")
            assert workers
            os.kill(workers[0], signal.SIGKILL)

        works_out_the_same(four_bar, executors.Ray(), kill)
    finally:
        ray.shutdown()


def test_spark_works_out_the_same_also_when_a_worker_dies(four_bar):
    pyspark = pytest.importorskip("pyspark")
    if shutil.which("java") is None:
        pytest.skip("Spark needs Java")
    settings = pyspark.SparkConf().set("spark.ui.enabled", "false")
    context = pyspark.SparkContext("local[2,4]", conf=settings)
    try:

        def kill():
            workers = children("pyspark.daemon")
            # the last begun is a worker, the first is what begins them
            os.kill(max(workers), signal.SIGKILL)

        with executors.Spark(context) as executor:
            # a job begins slowly
            works_out_the_same(four_bar, executor, kill, shards=12)
    finally:
        context.stop()


def test_processes_go_on_where_a_worker_died(four_bar, tmp_path):
    """A pool of processes ends with a worker: what is kept is not worked out again."""
    spawn = multiprocessing.get_context("spawn")
    whole = linkwork.study(four_bar, VARY, QUESTION, samples=900)
    options = {"samples": 900, "keep": tmp_path}
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=spawn) as pool:

        def progress(_, done, __):
            if done == 8:
                os.kill(next(iter(pool._processes)), signal.SIGKILL)

        with pytest.raises(concurrent.futures.process.BrokenProcessPool):
            linkwork.study(four_bar, VARY, QUESTION, executor=pool, progress=progress, **options)
    finished = len(list(tmp_path.iterdir()))
    assert 8 <= finished < 64
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=spawn) as pool:
        same(whole, linkwork.study(four_bar, VARY, QUESTION, executor=pool, **options))


def test_mpi_works_out_the_same_and_goes_on_where_a_worker_died(four_bar, tmp_path):
    """MPI ends with a worker: what is kept is not worked out again."""
    pytest.importorskip("mpi4py")
    if shutil.which("mpiexec") is None:
        pytest.skip("mpi4py needs an MPI, such as openmpi-bin")
    script = tmp_path / "study.py"
    script.write_text(
        "import sys, linkwork\n"
        "from mpi4py.futures import MPICommExecutor\n"
        "with MPICommExecutor() as executor:\n"
        "    if executor is not None:\n"
        "        m = linkwork.load(sys.argv[1])\n"
        f"        asked = m, {VARY!r}, {QUESTION!r}\n"
        "        linkwork.study_into(sys.argv[2], *asked, samples=3000, executor=executor, keep=sys.argv[3])\n"
    )
    # what Open MPI asks for in a container with few cores; others do not look at it
    allowed = dict.fromkeys(("ALLOW_RUN_AS_ROOT", "ALLOW_RUN_AS_ROOT_CONFIRM", "MCA_rmaps_base_oversubscribe"), "1")
    environment = {**os.environ, **{f"OMPI_{name}": value for name, value in allowed.items()}}
    linkwork.study_into(tmp_path / "serial.csv", four_bar, VARY, QUESTION, samples=3000)

    def begun(file, keep):
        command = ["mpiexec", "-n", "3", sys.executable, "-m", "mpi4py", script, SHIPPED / "four_bar.ron", file, keep]
        return subprocess.Popen(list(map(str, command)), env=environment)

    def finished():
        return {file: file.stat().st_mtime_ns for file in keep.glob("*.npz")}

    whole = tmp_path / "whole.csv"
    assert begun(whole, tmp_path / "all").wait(timeout=300) == 0
    assert whole.read_bytes() == (tmp_path / "serial.csv").read_bytes()
    whole, keep = tmp_path / "again.csv", tmp_path / "some"
    running = begun(whole, keep)
    while not finished():
        assert running.poll() is None
        time.sleep(0.005)
    ranks = [process for process in children(str(script)) if process != running.pid]
    os.kill(ranks[-1], signal.SIGKILL)
    assert running.wait(timeout=60) != 0 and not whole.exists()
    before = finished()
    assert 1 <= len(before) < 64
    assert begun(whole, keep).wait(timeout=300) == 0
    assert whole.read_bytes() == (tmp_path / "serial.csv").read_bytes()
    assert before.items() <= finished().items()
