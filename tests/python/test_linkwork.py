"""The Python module as a user has it: installed, with numpy."""

import concurrent.futures
import doctest
import json
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time
import warnings
from math import pi
from pathlib import Path

import numpy as np
import pytest

import linkwork
from linkwork import Mechanism, MechanismError, QuestionError, parts
from linkwork.parts import Actuated, Chain, Passive, Revolute, Tx

ROOT = Path(__file__).parents[2]
SHIPPED = ROOT / "mechanisms"


@pytest.fixture
def four_bar():
    return linkwork.load(SHIPPED / "four_bar.ron")


def command(*arguments):
    return subprocess.run(["linkwork", *map(str, arguments)], capture_output=True, text=True, check=False)


def coupler(p, theta1, phi1):
    """The length of the coupler of the 4-bar from the angles of crank and rocker alone."""
    x = p["l0"] + p["l3"] * np.cos(phi1) - p["l1"] * np.cos(theta1)
    return np.hypot(x, p["l3"] * np.sin(phi1) - p["l1"] * np.sin(theta1))


def test_a_four_bar_is_assembled_where_its_coupler_fits(four_bar):
    report = four_bar.solve(theta1=1.0)
    assert report and report.joints.theta1 == 1.0
    assert coupler(four_bar.parameters, 1.0, report.joints.phi1) == pytest.approx(four_bar.parameters["l2"], abs=1e-12)
    apart = four_bar.with_parameters(l2=0.1).solve(theta1=pi)
    assert not apart and "annot be assembled" in repr(apart)


def test_values_have_units_and_names_that_python_has_not(four_bar):
    a = four_bar.solve(theta1="60 deg")
    b = four_bar.solve(hold={"theta1": pi / 3})
    assert a.joints.phi1 == pytest.approx(b.joints.phi1, abs=1e-13)
    platform = linkwork.load(SHIPPED / "three_rps.ron")
    held = platform.solve(hold={"top.z": 0.6, "top.roll": 0.0, "top.pitch": "5 deg"}, free="actuated")
    assert held and held.platforms["top"].position[2] == 0.6
    # given in another order, the question is the same
    other = platform.solve(free="actuated", hold={"top.z": 0.6, "top.roll": 0.0, "top.pitch": "5 deg"})
    assert held == other


def test_assemblies_are_iterable_numbered_and_certified(four_bar):
    report = four_bar.assemblies(theta1=1.0)
    assert report.real == report.complex_count == len(report) == len(list(report)) == 2
    assert [mode.mode for mode in report] == [1, 2] and all(mode.certified for mode in report)
    for mode in report:
        length = coupler(four_bar.parameters, 1.0, mode.joints["phi1"])
        assert length == pytest.approx(four_bar.parameters["l2"], abs=1e-12)
    out_of_reach = four_bar.with_parameters(l2=0.1).assemblies(theta1=pi)
    assert out_of_reach.real == 0 and not out_of_reach


def test_a_sweep_is_a_mapping_of_arrays(four_bar):
    motion = four_bar.sweep("theta1", 0, 2 * pi, steps=36, of="left", report="transmission")
    assert motion and isinstance(motion, dict)
    assert isinstance(motion["phi1"], np.ndarray) and motion["phi1"].dtype == np.float64
    rows = np.isfinite(motion["step"])
    assert rows.sum() == 37
    np.testing.assert_allclose(motion["theta1"][rows], np.linspace(0, 2 * pi, 37), atol=1e-12)
    p = four_bar.parameters
    np.testing.assert_allclose(motion["left.x"], p["l0"] + p["l3"] * np.cos(motion["phi1"]), atol=1e-11)
    assert motion.units["theta1"] == "rad" and motion.units["left.x"] == "m"
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(motion)
    assert list(frame.columns) == list(motion) and len(frame) == len(motion["phi1"])


def test_many_rows_are_what_single_solves_are(four_bar):
    angles = np.linspace(0.2, 0.2 + 6 * pi, 5000)
    many = four_bar.solve_many(angles)
    assert many["reached"].all()
    lengths = coupler(four_bar.parameters, angles, many["phi1"])
    np.testing.assert_allclose(lengths, four_bar.parameters["l2"], atol=1e-11)
    home = four_bar.joints["theta1"].home
    one = four_bar.solve(theta1=home)
    assert four_bar.solve_many([home])["phi1"][0] == pytest.approx(one.joints.phi1, abs=1e-10)
    # the last block is not whole, and rows in any order are reached too
    mixed = np.random.default_rng(1).permutation(angles)[:777]
    found = four_bar.solve_many(mixed)
    assert found["reached"].all() and len(found["phi1"]) == 777
    np.testing.assert_allclose(
        coupler(four_bar.parameters, mixed, found["phi1"]), four_bar.parameters["l2"], atol=1e-11
    )


def test_rows_beyond_a_dead_point_are_not_reached(four_bar):
    # with a coupler of 1.7 m the crank cannot turn fully
    rocking = four_bar.with_parameters(l2=1.7)
    p = rocking.parameters
    angles = np.linspace(-pi, pi, 400)
    reach = np.hypot(p["l0"] - p["l1"] * np.cos(angles), p["l1"] * np.sin(angles))
    slack = np.minimum(p["l2"] + p["l3"] - reach, reach - abs(p["l2"] - p["l3"]))
    assert (slack > 0.01).any() and (slack < -0.01).any()
    many = rocking.solve_many(angles, hold={"theta1": 0.5})
    assert not many["reached"][slack < 0].any()
    assert np.isnan(many["phi1"][~many["reached"]]).all()
    assert many["reached"][slack > 0.01].sum() > 50
    found = many["reached"]
    np.testing.assert_allclose(coupler(p, angles[found], many["phi1"][found]), p["l2"], atol=1e-9)


def test_reports_say_what_the_command_line_says(four_bar):
    file = SHIPPED / "four_bar.ron"
    report = four_bar.mobility()
    assert repr(report) == command("mobility", file).stdout.rstrip("\n")
    assert report.to_json() == command("mobility", file, "--format", "json").stdout
    assert report.to_markdown() == command("mobility", file, "--format", "markdown").stdout
    # a part of a notebook's page: no policy, which counts in a head only, and no rules for what is outside
    shown = report._repr_html_()
    assert shown.startswith('<div class="linkwork">') and "<meta" not in shown and "\n.linkwork {" in shown
    assert "sentence" in dir(report) and report["sentence"] == report.sentence
    assert len(dir(report)) == len(set(dir(report)))
    with pytest.raises(AttributeError, match="there is no `freedom`"):
        report.freedom  # noqa: B018
    # a report of the same question from the command line
    swept = four_bar.sweep("theta1", 0, 1, steps=4)
    printed = command("sweep", file, "--input", "theta1=0..1", "--steps", "4").stdout
    assert repr(swept) == printed.rstrip("\n")


def test_every_question_has_an_answer(four_bar):
    assert four_bar.velocity(rate={"theta1": 1.0})
    assert (
        four_bar.statics(wrench={"left": (0, -10, 0)}).to_dict()
        == four_bar.statics(wrench={"left": "0,-10,0"}).to_dict()
    )
    assert four_bar.singularities() is not None
    along = four_bar.singularities(input={"theta1": (0, "90 deg")})
    assert isinstance(along, dict) and "theta1" in along
    assert four_bar.circuits(of="left").circuits
    assert four_bar.formulas() is not None
    assert four_bar.check().joints
    assert linkwork.load(SHIPPED / "three_rps.ron").compare(samples=5).agree
    assert four_bar.svg(labels=True).startswith("<svg") and four_bar.svg(mode="all") != four_bar.svg()
    hand = linkwork.load(SHIPPED / "five_bar_hand.ron")
    grid = hand.workspace({"hand.x": (-0.6, 0.8), "hand.y": (-0.1, 0.7)}, grid=5)
    assert len(grid["hand.x"]) == len(grid["condition"]) > 0


def test_mechanisms_are_made_of_python_data():
    made = Mechanism(
        name="4-bar",
        parameters={"l2": np.float64(4.0)},
        joints={"theta1": Actuated(home="1 rad"), "phi2": Passive(), "phi1": Passive()},
        chains={
            "left": Chain(rows=[{"theta": "theta1"}, {"a": 2.0, "theta": "phi2"}], tip=[Tx("l2")]),
            "right": Chain(rows=[{"theta": "phi1"}], base=[Tx(4.5)], tip=[Tx(3.5)]),
        },
        closures={"joint": Revolute("left", "right")},
    )
    assert made.assemblies(theta1=1.0).real == 2
    again = linkwork.parse(made.to_ron())
    assert again.solve(theta1=1.0).joints["phi1"] == made.solve(theta1=1.0).joints["phi1"]
    with pytest.raises(MechanismError, match=r"<Mechanism>:\d+:.*"):
        Mechanism(joints={"q": Actuated()}, chains={"arm": Chain(rows=[{"tetha": "q"}])})


def test_mechanisms_are_made_of_joint_axes(four_bar):
    z = (0, 0, 1)
    made = Mechanism.from_axes(
        joints={
            "theta1": Revolute(point=np.zeros(3), direction=z, between=("ground", "crank")),
            "phi2": Revolute(point=(2, 0, 0), direction=z, between=("crank", "coupler")),
            "B": Revolute(point=(2, 4, 0), direction=z, between=("coupler", "rocker")),
            "phi1": Revolute(point=(4.5, 0, 0), direction=z, between=("ground", "rocker")),
        },
    )
    report = made.assemblies()
    assert report.real == 2 and "joints" in made.to_ron(axes=True)


def test_errors_say_where_and_what_and_the_remedy(four_bar):
    with pytest.raises(QuestionError, match=r"(?s)`tetha1` is neither.*hold tetha1=1.*did you mean `theta1`\?"):
        four_bar.solve(hold={"tetha1": 1})
    with pytest.raises(QuestionError, match=r'free=\{?"theta1"'):
        four_bar.solve(phi1=1)
    with pytest.raises(QuestionError, match="velocity:phi1"):
        four_bar.sweep("theta1", 0, 1, report="velocty:phi1")
    with pytest.raises(MechanismError, match=r"wrong\.ron:1:"):
        linkwork.parse("Mechanism(name: )", "wrong.ron")
    with pytest.raises(MechanismError, match="l9"):
        four_bar.with_parameters(l9=1)
    with pytest.raises(FileNotFoundError):
        linkwork.load("no such file.ron")
    with pytest.raises(ValueError, match="column"):
        four_bar.solve_many(np.zeros((3, 2)))
    with pytest.raises(TypeError, match="did you mean `theta1`"):
        four_bar.solve(tetha1=1)
    with pytest.raises(TypeError, match="did you mean `steps`"):
        four_bar.sweep("theta1", 0, 1, step=4)
    with pytest.raises(QuestionError, match="no law"):
        four_bar.sweep("theta1", 0, 1, law="sudden")
    assert issubclass(QuestionError, linkwork.Error) and issubclass(linkwork.Error, ValueError)


@pytest.mark.parametrize(
    ("ask", "named"),
    [
        (lambda m: linkwork.load(3), "path"),
        (lambda m: linkwork.load(None), "path"),
        (lambda m: linkwork.parse(b"Mechanism()"), "text"),
        (lambda m: linkwork.parse("Mechanism()", 3), "name"),
        (lambda m: m.with_parameters(l1=None), r"parameters\["),
        (lambda m: m.with_parameters(l1=[1.0]), r"parameters\["),
        (lambda m: m.to_ron("yes"), "axes"),
        (lambda m: m.svg(labels=1), "labels"),
        (lambda m: m.solve(theta1=None), r"hold\[\"theta1\"\]"),
        (lambda m: m.solve(theta1=[1.0]), r"hold\[\"theta1\"\]"),
        (lambda m: m.solve(theta1=1j), r"hold\[\"theta1\"\]"),
        (lambda m: m.solve(theta1=True), r"hold\[\"theta1\"\]"),
        (lambda m: m.solve(hold=3), "hold"),
        (lambda m: m.solve(hold={3: 1.0}), "hold"),
        (lambda m: m.solve(guess="phi1"), "guess"),
        (lambda m: m.solve(free=3), "free"),
        (lambda m: m.solve(free=["theta1", 3]), "free"),
        (lambda m: m.solve(mode=1.5), "mode"),
        (lambda m: m.solve(mode=True), "mode"),
        (lambda m: m.solve(seed="one"), "seed"),
        (lambda m: m.solve(seed=-1), "seed"),
        (lambda m: m.solve(progress=3, mode=1), "progress"),
        (lambda m: m.assemblies(prove="yes"), "prove"),
        (lambda m: m.assemblies(all_complex=1), "all_complex"),
        (lambda m: m.sweep(3, 0, 1), "name"),
        (lambda m: m.sweep("theta1", 0, [1]), "input"),
        (lambda m: m.sweep(input=[("theta1", 0, 1)]), "input"),
        (lambda m: m.sweep(input={"theta1": 1}), "input"),
        (lambda m: m.sweep(input={"theta1": (0, 1, 2)}), "input"),
        (lambda m: m.sweep("theta1", 0, 1, steps=2.5), "steps"),
        (lambda m: m.sweep("theta1", 0, 1, steps=True), "steps"),
        (lambda m: m.sweep("theta1", 0, 1, law=3), "law"),
        (lambda m: m.sweep("theta1", 0, 1, duration="long"), "duration"),
        (lambda m: m.sweep("theta1", 0, 1, follow="no"), "follow"),
        (lambda m: m.sweep("theta1", 0, 1, report=3), "report"),
        (lambda m: m.sweep("theta1", 0, 1, of=[1]), "of"),
        (lambda m: m.sweep("theta1", 0, 1, dwell=3), "dwell"),
        (lambda m: m.circuits(of=3), "of"),
        (lambda m: m.mobility(lock=3), "lock"),
        (lambda m: m.velocity(rate=3), "rate"),
        (lambda m: m.velocity(rate={"theta1": None}), "rate"),
        (lambda m: m.velocity(acceleration=[1]), "acceleration"),
        (lambda m: m.velocity(point=3), "point"),
        (lambda m: m.statics(wrench=3), "wrench"),
        (lambda m: m.statics(wrench={"left": 3}), "wrench"),
        (lambda m: m.statics(wrench={"left": (1, None, 0)}), "wrench"),
        (lambda m: m.statics(load={"phi1": None}), "load"),
        (lambda m: m.singularities(output=3), "output"),
        (lambda m: m.singularities(locus=3), "locus"),
        (lambda m: m.singularities(starts="many"), "starts"),
        (lambda m: m.workspace(3), "map"),
        (lambda m: m.workspace({"theta1": (0, 1)}, grid="ten"), "grid"),
        (lambda m: m.workspace({"theta1": (0, 1)}, grid=[2.5]), "grid"),
        (lambda m: m.workspace({"theta1": (0, 1)}, search=1.5), "search"),
        (lambda m: m.formulas(of=3), "of"),
        (lambda m: m.compare(samples="many"), "samples"),
        (lambda m: m.compare(samples=10**30), "samples"),
        (lambda m: m.solve_many(None), "values"),
        (lambda m: m.solve_many("1"), "values"),
        (lambda m: m.solve_many([0.5, None]), "values"),
        (lambda m: m.solve_many([0.5, 1j]), "values"),
        (lambda m: m.solve_many(["0.5"]), "values"),
        (lambda m: m.solve_many([True, False]), "values"),
        (lambda m: m.solve_many(np.array([0.5, 1.0], dtype=complex)), "values"),
        (lambda m: m.solve_many(np.ma.array([0.5, 1.0], mask=[False, True])), "values"),
        (lambda m: m.solve_many(np.array([0.5, None], dtype=object)), "values"),
        (lambda m: m.solve_many([[0.5], [0.5, 1.0]]), "values"),
        (lambda m: m.solve_many([0.5], names=3), "names"),
        (lambda m: m.solve_many([0.5], progress="no"), "progress"),
    ],
)
def test_what_is_of_the_wrong_kind_is_named(four_bar, ask, named):
    with pytest.raises((TypeError, ValueError), match=f"^`{named}"):
        ask(four_bar)


def test_angles_of_many_turns_have_units_as_on_the_command_line(four_bar):
    """What the command line refuses is refused, with its remedy; what it takes is taken."""
    for ask in [
        lambda angle: four_bar.solve(theta1=angle),
        lambda angle: four_bar.solve(theta1=1.0, guess={"phi1": angle}),
        lambda angle: four_bar.sweep("theta1", 0, angle, steps=4),
        lambda angle: four_bar.velocity(rate={"theta1": angle}),
    ]:
        with pytest.raises(QuestionError, match="without a unit is in rad"):
            ask(360)
        with pytest.raises(QuestionError, match="360 ?deg"):
            ask(np.float64(360.0))
        ask("360 deg")
        ask(2 * pi)
    turns = four_bar.velocity(rate={"theta1": "360 deg/s"})
    assert turns == four_bar.velocity(rate={"theta1": "360 deg"})
    # in an array there is no place for units
    assert four_bar.solve_many([0.5, 0.5 + 8 * pi])["reached"].all()


def test_everything_pickles(four_bar):
    changed = four_bar.with_parameters(l1="1.1 m")
    again = pickle.loads(pickle.dumps(changed))
    assert again == changed and again.parameters == changed.parameters
    for report in (changed.sweep("theta1", 0, 1, steps=4), changed.mobility()):
        copy = pickle.loads(pickle.dumps(report))
        assert copy == report and repr(copy) == repr(report) and copy._repr_html_() == report._repr_html_()
        assert pickle.loads(pickle.dumps(copy)) == report
    with pytest.raises(QuestionError) as caught:
        four_bar.solve(hold={"tetha1": 1})
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)


def test_a_notebook_shows_the_page_and_the_picture(four_bar):
    shown = four_bar._repr_html_()
    assert shown.startswith("<iframe srcdoc=") and 'sandbox="allow-scripts"' in shown
    assert four_bar.page().count("four_bar.ron") == 1 and "<script" in four_bar.page()
    assert four_bar._repr_svg_() in shown
    assert four_bar.with_parameters(l2=0.1)._repr_svg_() is None


def test_progress_is_shown_and_an_error_in_it_ends_the_work():
    hand = linkwork.load(SHIPPED / "stewart_gough_6ups.ron")
    seen = []

    def progress(stage, done, of):
        seen.append((stage, done, of))
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        hand.assemblies(progress=progress)
    assert len(seen) == 1 and isinstance(seen[0][0], str) and threading.active_count() == 1


def test_ctrl_c_ends_long_work():
    script = """
        import linkwork, sys, threading, time
        m = linkwork.load(sys.argv[1])
        print("begun", flush=True)
        try:
            while True:
                m.assemblies()
        except KeyboardInterrupt:
            print("interrupted")
    """
    arguments = [sys.executable, "-c", textwrap.dedent(script), str(SHIPPED / "stewart_gough_6sps.ron")]
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "begun\n"
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        assert process.communicate(timeout=10)[0] == "interrupted\n"


@pytest.mark.parametrize("values", ["np.linspace(0.5, 0.9, 10_000_000)", "np.tile([0.5, 0.5, 1500.0, 1500.0], 4000)"])
def test_ctrl_c_ends_many_rows(values):
    """Rows side by side, and rows that are thousands of steps from one another."""
    script = f"""
        import linkwork, sys, threading, time
        import numpy as np
        m = linkwork.load(sys.argv[1])
        rows = {values}
        print("begun", flush=True)
        try:
            while True:
                m.solve_many(rows)
        except KeyboardInterrupt:
            print("interrupted")
    """
    arguments = [sys.executable, "-c", textwrap.dedent(script), str(SHIPPED / "four_bar.ron")]
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "begun\n"
        time.sleep(0.3)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        assert process.communicate(timeout=10)[0] == "interrupted\n"


def solved(m):
    return m.assemblies().real, m.solve_many(np.linspace(0.5, 0.9, 3000))["phi1"].sum()


@pytest.mark.skipif(sys.platform == "win32", reason="no fork")
def test_forked_processes_have_threads_of_their_own(four_bar):
    here = solved(four_bar)
    context = __import__("multiprocessing").get_context("fork")
    with warnings.catch_warnings(), concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as executor:
        warnings.simplefilter("ignore")
        assert list(executor.map(solved, [four_bar, four_bar], timeout=60)) == [here, here]


def test_threads_ask_side_by_side(four_bar):
    with concurrent.futures.ThreadPoolExecutor(4) as executor:
        reports = list(executor.map(lambda angle: four_bar.solve(theta1=angle), [0.5, 0.6, 0.7, 0.8]))
    assert [report.joints.theta1 for report in reports] == [0.5, 0.6, 0.7, 0.8]


def test_the_command_line_comes_with_it():
    shown = command("--version")
    assert shown.stdout.split()[1] == linkwork.__version__
    assert command("solve", "no such file").returncode == 2
    assert json.loads(command("solve", SHIPPED / "four_bar.ron", "--format", "json").stdout)["outcome"] == "converged"


@pytest.mark.parametrize("module", [linkwork, parts])
def test_examples_in_the_documentation_are_right(module):
    result = doctest.testmod(module)
    assert result.attempted > 1 and result.failed == 0


@pytest.mark.parametrize("page", [ROOT / "README.md", ROOT / "src/guide/python.md"], ids=["README", "guide"])
def test_the_pages_run(page, monkeypatch, tmp_path):
    """The blocks of a page are one program, run where it finds the mechanisms; a comment behind an expression is what
    it prints."""
    (tmp_path / "mechanisms").symlink_to(SHIPPED)
    monkeypatch.chdir(tmp_path)
    blocks = page.read_text(encoding="utf-8").split("```python\n")[1:]
    assert blocks
    names = {"__name__": "page"}
    for block in blocks:
        code = block.split("```")[0]
        exec(compile(code, str(page), "exec"), names)
        for line in code.splitlines():
            expression, _, comment = line.partition("  # ")
            if comment.startswith("→ "):
                assert repr(eval(expression, names)).splitlines()[0] == comment[2:], line


def test_rows_in_no_order_are_found_where_rows_in_order_are():
    """The crank turns round, so each of its angles is on the branch of home; a platform's rows close on their legs."""
    m = linkwork.load(SHIPPED / "four_bar.ron")
    angles = np.linspace(0, 2 * np.pi, 5001)
    mixed = np.random.default_rng(7).permutation(len(angles))
    path, found = m.solve_many(angles), m.solve_many(angles[mixed])
    assert path["reached"].all() and found["reached"].all()
    for name in ("theta1", "phi1", "phi2"):
        np.testing.assert_allclose(found[name], path[name][mixed], atol=1e-9)
    m = linkwork.load(SHIPPED / "planar_3rpr.ron")
    names = [name for name, joint in m.joints.items() if joint.driven]
    home = np.array([m.joints[name].home for name in names])
    rows = home + np.random.default_rng(8).uniform(-0.5, 0.5, (3000, len(names)))
    found = m.solve_many(rows)
    assert found["reached"].mean() > 0.9
    for i, name in enumerate(names):
        np.testing.assert_array_equal(found[name][found["reached"]], rows[found["reached"], i])
    again = m.solve_many(rows)
    assert all(found[name].tobytes() == again[name].tobytes() for name in found)


def test_a_jacobian_is_an_array():
    platform = linkwork.load(SHIPPED / "three_rps.ron")
    found = platform.jacobian(l1=0.7)
    named = platform.velocity(l1=0.7).jacobian
    assert found.shape == (len(named.rows), 3) and [column.name for column in named.columns] == ["l1", "l2", "l3"]
    # what differences of assembled configurations say
    step = 1e-6
    heights = [platform.solve(l1=0.7 + part).platforms["top"].position[2] for part in (-step, step)]
    row = [axis.name for axis in named.rows].index("top vz")
    assert found[row, 0] == pytest.approx((heights[1] - heights[0]) / (2 * step), rel=1e-5)
    singular = linkwork.load(SHIPPED / "parallelogram.ron")
    with pytest.raises(QuestionError):
        singular.jacobian()


def test_jacobians_of_many_rows_are_those_of_velocity():
    three_rps = linkwork.load(SHIPPED / "three_rps.ron")
    rng = np.random.default_rng(3)
    # away from the dead points of the branch
    rows = np.array([2 / 3, 0.65, 3 / 4]) + rng.uniform(-0.02, 0.02, (300, 3))
    many = three_rps.solve_many(rows, report="condition", jacobian=True)
    assert many["reached"].all() and many["jacobian"].shape == (300, len(many.outputs), 3)
    assert many.inputs == ["l1", "l2", "l3"]
    for row in (0, 7, 299):
        held = dict(zip(("l1", "l2", "l3"), rows[row]))
        guess = {name: many[name][row] for name in ("phi1", "phi2", "phi3")}
        report = three_rps.velocity(guess=guess, **held)
        assert [axis["name"] for axis in report.to_dict()["jacobian"]["rows"]] == many.outputs
        alone = three_rps.jacobian(guess=guess, **held)
        assert np.allclose(alone, many["jacobian"][row], rtol=1e-6, atol=1e-9)
        assert report.jacobian.condition == pytest.approx(many["condition"][row], rel=1e-6)
    # and are what differences of neighbouring rows say
    step = 1e-6
    moved = three_rps.solve_many(np.array([rows[0], rows[0] + [step, 0, 0]]))
    slope = (moved["top.z"][1] - moved["top.z"][0]) / step
    assert slope == pytest.approx(many["jacobian"][0][many.outputs.index("top vz"), 0], rel=1e-4)


def test_rows_that_fail_say_why_and_can_be_searched(four_bar):
    short = four_bar.with_parameters(l1=2.0, l2=2.5)
    rows = np.array([1.0, np.nan, 3.1, 1.1])
    many = short.solve_many(rows)
    assert list(many["reached"]) == [True, False, False, True]
    assert set(many.reasons) == {1, 2} and "finite" in many.reasons[1] and "search=True" in many.reasons[2]
    assert "row 1" in repr(many) and "2 of 4 rows" in repr(many)
    searched = short.solve_many(rows, search=True)
    assert "no assembly" in searched.reasons[2] and not short.solve(theta1=3.1)
    assert np.isnan(searched["phi1"][2]) and np.array_equal(searched["phi1"][[0, 3]], many["phi1"][[0, 3]])


def test_numbers_of_parameters_are_put_in_as_they_are_read(four_bar):
    fast, read = four_bar.with_parameters(l2=3.25), four_bar.with_parameters(l2="3.25")
    assert fast.parameters == read.parameters and fast.parameters["l2"] == 3.25
    assert fast.solve(theta1=1.0).joints == read.solve(theta1=1.0).joints
    assert "3.25" in fast.to_ron() and fast.with_parameters(l1=1.5).parameters["l2"] == 3.25
    assert pickle.loads(pickle.dumps(fast)).solve(theta1=1.0).joints == fast.solve(theta1=1.0).joints
    with pytest.raises(linkwork.MechanismError):
        four_bar.with_parameters(l9=3.25)


def test_parts_are_listed_and_imported():
    names: dict = {}
    exec("from linkwork.parts import *", names)
    assert repr(names["Revolute"]("a", "b")) == 'Revolute("a", "b")' and "Mechanism" not in names
    assert {"Tx", "Chain", "Actuated"} <= set(dir(linkwork.parts))
    assert "Mechanism" in dir(linkwork) and "np" not in dir(linkwork)
    for name in linkwork.parts.__all__:
        assert isinstance(names[name](), linkwork.parts.Part)


def test_the_module_is_the_command_line():
    said = subprocess.run([sys.executable, "-m", "linkwork", "--version"], capture_output=True, text=True)
    assert said.returncode == 0 and said.stdout == f"linkwork {linkwork.__version__}\n"


#: A rod 2 m long on a pin, hanging along -y at -90 degrees.
PENDULUM = """Axes(version: 1, name: "pendulum", gravity: (0, -9.81, 0),
    joints: { "pin": Revolute(point: (0, 0, 0), direction: (0, 0, 1), between: ("ground", "rod"), role: Actuated) },
    points: { "middle": (body: "rod", at: (1, 0, 0)) }, masses: { "middle": (mass: 3, shape: Rod(2)) })"""


def test_a_pendulum_is_let_go_and_rests() -> None:
    pendulum = linkwork.parse(PENDULUM)
    motion = pendulum.simulate(1.0, rows=4, pin="-80 deg", rate={"pin": 0.5}, of="middle")
    assert motion["t"].tolist() == [0, 0.25, 0.5, 0.75, 1]
    assert motion.units["rate:pin"] == "rad/s"
    assert np.allclose(motion["middle.x"], np.cos(motion["pin"]))
    # inertia about the pin 4 kg m2; energy from the angle and the rate
    energy = 2 * motion["rate:pin"] ** 2 + 3 * 9.81 * np.sin(motion["pin"])
    assert np.ptp(energy) < 1e-8
    assert motion["kinetic energy"][0] == pytest.approx(0.5)
    hangs = pendulum.equilibrium()
    assert hangs.positions[0].joints.pin == pytest.approx(-np.pi / 2, abs=1e-9)
    assert hangs.positions[0].stability == "stable"
    assert len(pendulum.equilibrium(all=True, starts=20).positions) == 2
    # held along x by the moment of the weight, and by none without it
    assert pendulum.statics(pin=0.0).to_dict() != pendulum.statics(pin=0.0, without="weight").to_dict()
    with pytest.raises(linkwork.QuestionError, match="restitution"):
        pendulum.simulate(restitution=2)
    with pytest.raises(linkwork.QuestionError, match="time"):
        pendulum.simulate(-1.0)
    assert not pendulum.simulate(1.0, lock="pin")


def test_designs(four_bar):
    # Freudenstein's linkage for y = log10 x: one four-bar for three pairs of angles
    crank = np.array([0.855547097937193, 1.30899693899575, 1.7624467800543])
    rocker = np.array([2.50313149378569, 3.27505143763789, 3.84978793301345])
    positions = [{"theta1": x, "phi1": y} for x, y in zip(crank, rocker)]
    report = four_bar.design({"l1": (-50, 50), "l2": (0, 50), "l3": (-50, 50)}, positions)
    found = report.to_dict()
    assert report and found["exact"]["real"] == 1 and len(found["designs"]) == 1
    made = linkwork.parse(found["designs"][0]["file"])
    assert coupler(made.parameters, crank, rocker) == pytest.approx(made.parameters["l2"], abs=1e-9)
    assert coupler(four_bar.parameters, crank, rocker) != pytest.approx(four_bar.parameters["l2"], abs=1e-3)
    # a quantity alone is no figure over the motion
    with pytest.raises(QuestionError, match="no figure"):
        four_bar.design({"l1": (0.5, 2)}, positions, maximise="transmission")
    with pytest.raises(TypeError, match="maximise"):
        four_bar.design({"l1": (0.5, 2)}, positions, maximise=3)
