"""Studies: the same rows, whoever works them out."""

import concurrent.futures
import multiprocessing
import os
import signal
import subprocess
import time
from math import pi
from pathlib import Path

import numpy as np
import pytest

import linkwork

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
        assert broken.returncode == 2 and "are missing" in broken.stderr


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


def test_a_cluster_of_dask_works_out_the_same_also_when_a_worker_dies(four_bar):
    distributed = pytest.importorskip("distributed")
    points = {"samples": 900}
    whole = linkwork.study(four_bar, VARY, "phi1, transmission, assemblies", **points)
    with (
        distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        executor = client.get_executor()
        same(whole, linkwork.study(four_bar, VARY, "phi1, transmission, assemblies", executor=executor, **points))
        worker = next(iter(client.run(os.getpid).values()))
        with concurrent.futures.ThreadPoolExecutor(1) as aside:
            # another question about it, so that the cluster has no results of it yet
            asked = aside.submit(
                linkwork.study,
                four_bar,
                VARY,
                "phi1, transmission, assemblies, phi2",
                executor=executor,
                **points,
            )
            time.sleep(0.2)
            assert not asked.done()
            os.kill(worker, signal.SIGKILL)
            again = asked.result(timeout=120)
        again.pop("phi2")
        same(whole, again)
