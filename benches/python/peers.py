"""One assembled configuration after another in Python: linkwork beside other packages, in one paired run.

    pip install linkwork pin mujoco scipy "pylinkage[numba]"
    python benches/python/peers.py

Each package follows the same driven values of the shipped files from the same start, and must come to the same places.
Pinocchio and MuJoCo have the closures as constraints; the user's part is Newton's method on the residual and Jacobian
that they give. scipy solves the fewest equations one would write by hand. Rounds take all packages in turn, on one
thread; what is printed is the median over the rounds of the time on the processor.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import os
import platform
import statistics
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS"):
    os.environ[threads] = "1"

import numpy as np  # noqa: E402

import linkwork  # noqa: E402

SHIPPED = Path(__file__).parents[2] / "mechanisms"
ROUNDS = 7
CLOSED = 1e-10


class Work:
    """A mechanism with rows of driven values."""

    def __init__(self, title: str, file: str, amplitude: float, watched: list[str]) -> None:
        self.title = title
        self.file = SHIPPED / file
        self.m = linkwork.load(self.file)
        self.driven = [name for name, joint in self.m.joints.items() if joint.driven]
        self.home = np.array([self.m.joints[name].home for name in self.driven])
        if title == "3-RPS":
            # its home is near a fold, where the methods would be judged by their luck
            self.home[:] = 0.7
        self.amplitude = amplitude
        self.watched = watched

    def rows(self, count: int) -> np.ndarray:
        """A closed path; the 4-bar's crank turns round."""
        turn = np.linspace(0, 2 * np.pi, count)[:, None]
        if len(self.driven) == 1:
            return self.home + turn
        phase = 0.8 * np.arange(len(self.driven))
        return self.home + self.amplitude * (np.sin(turn + phase) - np.sin(phase))


def works() -> list[Work]:
    """What is solved."""
    platform_of = ["top.x", "top.y", "top.z"]
    return [
        Work("4-bar", "four_bar.ron", 0, ["phi1"]),
        Work("3-RPS", "three_rps.ron", 0.03, platform_of),
        Work("6-SPS", "stewart_gough_6sps.ron", 0.05, platform_of),
    ]


def legs(work: Work) -> Iterator[tuple[np.ndarray, float, str, np.ndarray | None]]:
    """Of each leg: its foot, the turn of the foot about z, its joints (turns about x and y, s for a slide along z), and
    its end on the platform."""
    p = work.m.parameters
    if work.title == "3-RPS":
        for turn in (0, 2 * np.pi / 3, 4 * np.pi / 3):
            out = np.array([np.cos(turn), np.sin(turn), 0])
            yield p["b"] * out, turn, "ys", p["a"] * out
    else:
        for i in range(1, 7):
            foot, end = ([p[f"{letter}{i}{axis}"] for axis in "xyz"] for letter in "ab")
            yield np.array(foot), 0.0, "xys", np.array(end)


def newton(q: Any, residual: Callable, advance: Callable) -> Any:
    """Newton's method with a least-squares step, as closures are redundant."""
    for _ in range(30):
        r, jacobian = residual(q)
        if np.abs(r).max() < CLOSED:
            return q
        q = advance(q, np.linalg.lstsq(jacobian, -r, rcond=1e-8)[0])
    raise RuntimeError("not closed")


def start(work: Work) -> Any:
    """The configuration where all begin."""
    return work.m.solve(**dict(zip(work.driven, work.rows(2)[0])))


def pinocchio(work: Work) -> Callable[[np.ndarray], np.ndarray]:
    """Tree with point anchors; the driven values are written into q, the others are solved for."""
    pin = importlib.import_module("pinocchio")
    model, constraints, driven, begin = pin.Model(), [], [], []
    at, turned = pin.SE3(np.eye(3), np.zeros(3)), pin.JointModelRZ
    moved = lambda *t: pin.SE3(np.eye(3), np.array(t, dtype=float))  # noqa: E731
    known = start(work)
    if work.title == "4-bar":
        p = work.m.parameters
        one = model.addJoint(0, turned(), at, "theta1")
        two = model.addJoint(one, turned(), moved(p["l1"], 0, 0), "phi2")
        three = model.addJoint(0, turned(), moved(p["l0"], 0, 0), "phi1")
        ends = [(two, moved(p["l2"], 0, 0), three, moved(p["l3"], 0, 0))]
        driven = [0]
        begin = [known.joints.theta1, known.joints.phi2, known.joints.phi1]
    else:
        kinds = {"x": pin.JointModelRX, "y": pin.JointModelRY, "s": pin.JointModelPZ}
        top = model.addJoint(0, pin.JointModelFreeFlyer(), at, "top")
        frame = known.platforms["top"]
        begin = [*frame.position, *frame.quaternion[1:], frame.quaternion[0]]
        ends = []
        for i, (foot, turn, joints, end) in enumerate(legs(work)):
            parent, place = 0, pin.SE3(pin.utils.rotate("z", turn), foot)
            for kind in joints:
                parent = model.addJoint(parent, kinds[kind](), place, f"{kind}{i}")
                place = at
            driven.append(model.joints[parent].idx_v)
            begin += leg_start(work, i, known)
            ends.append((parent, at, top, pin.SE3(np.eye(3), end)))
    for a, place_a, b, place_b in ends:
        constraints.append(pin.PointAnchorConstraintModel(model, a, place_a, b, place_b))
    data = model.createData()
    datas = [c.createData() for c in constraints]
    free = [i for i in range(model.nv) if i not in driven]
    at_q = [next(j.idx_q for j in model.joints if j.idx_v == v and j.nv == 1) for v in driven]

    def residual(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        pin.computeJointJacobians(model, data, q)
        parts, jacobians = [], []
        for constraint, of in zip(constraints, datas):
            constraint.calc(model, data, of)
            parts.append(of.constraint_position_error)
            jacobians.append(constraint.jacobian(model, data, of))
        return np.concatenate(parts), np.vstack(jacobians)[:, free]

    step = np.zeros(model.nv)

    def advance(q: np.ndarray, change: np.ndarray) -> np.ndarray:
        step[free] = change
        return pin.integrate(model, q, step)

    def run(rows: np.ndarray) -> np.ndarray:
        q = np.array(begin, dtype=float)
        found = np.empty((len(rows), len(work.watched)))
        for k, row in enumerate(rows):
            q[at_q] = row
            q = newton(q, residual, advance)
            found[k] = q[2] if work.title == "4-bar" else q[:3]
        return found

    return run


def leg_start(work: Work, i: int, known: Any) -> list[float]:
    """Joints of a leg where all begin."""
    length = known.joints[work.driven[i]]
    if work.title == "3-RPS":
        return [-known.joints[f"phi{i + 1}"], length]
    foot, _, _, end = list(legs(work))[i]
    along = (
        np.array(known.platforms["top"].position) + rotation(known.platforms["top"].quaternion) @ end - foot
    ) / length
    # z of Rx(u) Ry(v) is (sin v, -sin u cos v, cos u cos v)
    return [np.arctan2(-along[1], along[2]), np.arcsin(along[0]), length]


def rotation(q: list[float]) -> np.ndarray:
    """The matrix of a quaternion w, x, y, z."""
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def mujoco(work: Work) -> Callable[[np.ndarray], np.ndarray]:
    """Bodies with `connect` equalities; residual and Jacobian are efc_pos and efc_J."""
    mj = importlib.import_module("mujoco")
    known = start(work)
    speck = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
    if work.title == "4-bar":
        p = work.m.parameters
        bodies = (
            f'<body name="a">{speck}<joint axis="0 0 1"/>'
            f'<body name="b" pos="{p["l1"]} 0 0">{speck}<joint axis="0 0 1"/>'
            f'<site name="e0" pos="{p["l2"]} 0 0"/></body></body><body name="c" pos="{p["l0"]} 0 0">{speck}'
            f'<joint axis="0 0 1"/><site name="f0" pos="{p["l3"]} 0 0"/></body>'
        )
        begin, count = [known.joints.theta1, known.joints.phi2, known.joints.phi1], 1
    else:
        frame = known.platforms["top"]
        begin, sites, feet = [*frame.position, *frame.quaternion], "", ""
        axes = {"x": "1 0 0", "y": "0 1 0", "s": "0 0 1"}
        count = 0
        for i, (foot, turn, joints, end) in enumerate(legs(work)):
            place = f'pos="{foot[0]!r} {foot[1]!r} {foot[2]!r}" euler="0 0 {turn!r}"'.replace(
                "np.float64(", ""
            ).replace(")", "")
            for kind in joints:
                kinds = "slide" if kind == "s" else "hinge"
                feet += f'<body {place}>{speck}<joint type="{kinds}" axis="{axes[kind]}"/>'
                place = ""
            feet += f'<site name="e{i}"/>' + "</body>" * len(joints)
            sites += '<site name="f{}" pos="{} {} {}"/>'.format(i, *map(float, end))
            begin += leg_start(work, i, known)
            count += 1
        bodies = f'<body name="top">{speck}<freejoint/>{sites}</body>{feet}'
    equal = "".join(f'<connect site1="e{i}" site2="f{i}"/>' for i in range(count))
    model = mj.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian"/><option jacobian="dense"/><worldbody>{bodies}</worldbody>'
        f"<equality>{equal}</equality></mujoco>"
    )
    data = mj.MjData(model)
    if work.title == "4-bar":
        driven, at_q = [0], [0]
    else:
        slides = [j for j in range(model.njnt) if model.jnt_type[j] == mj.mjtJoint.mjJNT_SLIDE]
        driven, at_q = [model.jnt_dofadr[j] for j in slides], [model.jnt_qposadr[j] for j in slides]
    free = [i for i in range(model.nv) if i not in driven]
    step = np.zeros(model.nv)

    def residual(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        data.qpos[:] = q
        mj.mj_kinematics(model, data)
        mj.mj_comPos(model, data)
        mj.mj_makeConstraint(model, data)
        return data.efc_pos, data.efc_J.reshape(-1, model.nv)[:, free]

    def advance(q: np.ndarray, change: np.ndarray) -> np.ndarray:
        step[free] = change
        mj.mj_integratePos(model, q, step, 1.0)
        return q

    def run(rows: np.ndarray) -> np.ndarray:
        q = np.array(begin, dtype=float)
        found = np.empty((len(rows), len(work.watched)))
        for k, row in enumerate(rows):
            q[at_q] = row
            q = newton(q, residual, advance)
            found[k] = q[2] if work.title == "4-bar" else q[:3]
        return found

    return run


def scipy(work: Work) -> Callable[[np.ndarray], np.ndarray]:
    """`fsolve` on two angles, three angles, or six coordinates of the platform."""
    fsolve = importlib.import_module("scipy.optimize").fsolve
    known = start(work)
    p = work.m.parameters
    if work.title == "4-bar":

        def gap(x: np.ndarray, row: np.ndarray) -> list[float]:
            a, b, c = row[0], row[0] + x[0], x[1]
            return [
                p["l1"] * np.cos(a) + p["l2"] * np.cos(b) - p["l0"] - p["l3"] * np.cos(c),
                p["l1"] * np.sin(a) + p["l2"] * np.sin(b) - p["l3"] * np.sin(c),
            ]

        begin, ends = [known.joints.phi2, known.joints.phi1], lambda x, _: x[1]
    elif work.title == "3-RPS":
        out = np.array([[np.cos(t), np.sin(t), 0] for t in (0, 2 * np.pi / 3, 4 * np.pi / 3)])
        up, side = np.array([0, 0, 1.0]), p["a"] ** 2 * 3

        def balls(x: np.ndarray, row: np.ndarray) -> np.ndarray:
            return out * (p["b"] - row * np.sin(x))[:, None] + up * (row * np.cos(x))[:, None]

        def gap(x: np.ndarray, row: np.ndarray) -> np.ndarray:
            s = balls(x, row)
            return ((s - s[[1, 2, 0]]) ** 2).sum(axis=1) - side

        begin = [known.joints[f"phi{i}"] for i in (1, 2, 3)]
        ends = lambda x, row: balls(x, row).mean(axis=0)  # noqa: E731
    else:
        foot, end = (np.array(list(of)) for of in zip(*((foot, end) for foot, _, _, end in legs(work))))

        def gap(x: np.ndarray, row: np.ndarray) -> np.ndarray:
            q = np.array([1.0, *x[3:] / 2])
            far = x[:3] + end @ rotation(q / np.sqrt(q @ q)).T - foot
            return (far**2).sum(axis=1) - row**2

        quaternion = known.platforms["top"].quaternion
        begin = [*known.platforms["top"].position, *(2 * np.array(quaternion[1:]) / quaternion[0])]
        ends = lambda x, _: x[:3]  # noqa: E731

    def run(rows: np.ndarray) -> np.ndarray:
        x = np.array(begin, dtype=float)
        found = np.empty((len(rows), len(work.watched)))
        for k, row in enumerate(rows):
            x = fsolve(gap, x, args=(row,), xtol=1e-12)
            found[k] = ends(x, row)
        return found

    return run


def pylinkage(work: Work) -> Callable[[np.ndarray], np.ndarray] | None:
    """A crank and a dyad, in closed form, compiled by numba; it has no mechanisms in space."""
    if work.title != "4-bar":
        return None
    lib = importlib.import_module("pylinkage")
    p, known = work.m.parameters, start(work)

    def run(rows: np.ndarray) -> np.ndarray:
        step = rows[1, 0] - rows[0, 0]
        # `step_fast` turns the crank before it writes the first row
        angle = rows[0, 0] - step
        ground, far = lib.Ground(0.0, 0.0), lib.Ground(p["l0"], 0.0)
        crank = lib.Crank(anchor=ground, radius=p["l1"], angular_velocity=step, initial_angle=angle)
        end = p["l0"] + p["l3"] * np.cos(known.joints.phi1), p["l3"] * np.sin(known.joints.phi1)
        dyad = lib.RRRDyad(crank.output, far, p["l2"], p["l3"])
        dyad.x, dyad.y = end
        linkage = lib.Linkage([ground, far, crank, dyad])
        places = linkage.step_fast(len(rows))[:, 3]
        return np.unwrap(np.arctan2(places[:, 1], places[:, 0] - p["l0"]))[:, None]

    return run


def one_by_one(work: Work) -> Callable[[np.ndarray], np.ndarray]:
    """A report for each row."""

    def run(rows: np.ndarray) -> np.ndarray:
        found = np.empty((len(rows), len(work.watched)))
        for row in rows:
            report = work.m.solve(**dict(zip(work.driven, row)))
            assert report
        at = work.m.solve(**dict(zip(work.driven, rows[-1])))
        found[:] = at.joints.phi1 if work.title == "4-bar" else at.platforms["top"].position
        return found

    return run


def many(work: Work) -> Callable[[np.ndarray], np.ndarray]:
    """All rows at once."""

    def run(rows: np.ndarray) -> np.ndarray:
        found = work.m.solve_many(rows)
        assert found["reached"].all()
        return np.column_stack([found[name] for name in work.watched])

    return run


#: Each package with the rows that it is given.
PACKAGES: dict[str, tuple[Callable[[Work], Any], int]] = {
    "linkwork, solve_many": (many, 100_000),
    "linkwork, solve": (one_by_one, 1_000),
    "pylinkage, step_fast": (pylinkage, 100_000),
    "scipy, fsolve": (scipy, 1_000),
    "MuJoCo": (mujoco, 1_000),
    "Pinocchio": (pinocchio, 1_000),
}


def main() -> None:
    """Prints the table in Markdown."""
    print(f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}")
    for name in ("linkwork", "pin", "mujoco", "scipy", "pylinkage", "numpy"):
        try:
            print(name, importlib.metadata.version(name), end="  ")
        except importlib.metadata.PackageNotFoundError:
            print(name, "is not installed", end="  ")
    print("\n")
    table: dict[str, list[str]] = {package: [] for package in PACKAGES}
    for work in works():
        runs = {}
        for package, (make, count) in PACKAGES.items():
            try:
                run = make(work)
            except ImportError:
                run = None
            if run is None:
                continue
            rows = work.rows(count)
            expected = np.column_stack([work.m.solve_many(rows)[name] for name in work.watched])
            worst = np.abs(np.exp(1j * run(rows)[-1]) - np.exp(1j * expected[-1])).max()
            all_of = np.abs(np.exp(1j * run(rows)) - np.exp(1j * expected)).max() if make is not one_by_one else worst
            assert max(worst, all_of) < 1e-6, (work.title, package, worst, all_of)
            runs[package] = (run, rows)
        times: dict[str, list[float]] = {package: [] for package in runs}
        for _ in range(ROUNDS):
            for package, (run, rows) in runs.items():
                begun = time.process_time()
                run(rows)
                times[package].append((time.process_time() - begun) / len(rows))
        for package, cells in table.items():
            found = times.get(package)
            cells.append(f"{1e6 * statistics.median(found):.3g} µs" if found else "–")
    print(f"| one solution | {' | '.join(work.title for work in works())} |\n|---|---|---|---|")
    for package, cells in table.items():
        print(f"| {package} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
