"""Accelerations of shipped mechanisms by Pinocchio, for tests/analyses/let_go.rs.

linkwork exports the trees as URDF and names the closures that URDF cannot express; `solve` gives the configuration.
Pinocchio gives the mass matrix M, the bias c, and for the frames at each closure Jacobians and accelerations; q'' solves
M q'' + c = J^T l and J q'' = -J' q' exactly.

    python3 tests/data/accelerations_pinocchio.py LINKWORK > tests/data/accelerations_pinocchio.json     (pip install pin)
"""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pinocchio as pin

FOLDER = Path(__file__).resolve().parents[2] / "mechanisms" / "loads"
CASES = {
    "four_bar_let_go": {"theta": 3.0},
    "andrews_squeezer": {"beta": 4.0},
    "engine": {"theta": 10.0},
    "trebuchet": {"beam": 0.7, "hanger": -0.4, "sling": 1.1},
    "flyball_governor": {"spin": 2.0, "left": 0.5, "right": 0.5, "s": -0.3},
    "wishbone": {"lower": 1.5},
}
CLOSURE = re.compile(r"cannot express the closure of `(.*?)` and `(.*?)` \((\w+)\)")


def run(*arguments):
    return subprocess.run([sys.argv[1], *map(str, arguments)], capture_output=True, text=True)


def configuration(model, solved):
    """The numbers of a configuration from the values of joints and the poses of platforms."""
    q = pin.neutral(model)
    for joint, name, origin in list(zip(model.joints, model.names, model.jointPlacements))[1:]:
        if joint.nq == 1:
            q[joint.idx_q] = solved["joints"][name]
        elif joint.nq == 2:
            q[joint.idx_q : joint.idx_q + 2] = np.cos(solved["joints"][name]), np.sin(solved["joints"][name])
        elif joint.nq == 7:
            (pose,) = solved["platforms"].values()
            placed = pin.SE3(np.array(pose["rotation"]), np.array(pose["position"]))
            q[joint.idx_q : joint.idx_q + 7] = pin.SE3ToXYZQUAT(origin.inverse() * placed)
    return q


def accelerations(name, rates):
    file = FOLDER / f"{name}.ron"
    export = run("export", file, "--to", "urdf")
    closures = CLOSURE.findall(export.stderr)
    model = pin.buildModelFromXML(export.stdout)
    solved = json.loads(run("solve", file, "--format", "json").stdout)
    gravity = re.search(r'gravity: \((.*?)\)', file.read_text())
    numbers = [float(x.strip().strip('"').split()[0]) for x in gravity[1].split(",")] if gravity else [0.0] * 3
    model.gravity.linear = np.array(numbers)
    data = model.createData()
    q = configuration(model, solved)
    nothing = np.zeros(model.nv)

    def rows(v):
        """Rows of the closures' Jacobian, with their accelerations for q'' = 0."""
        pin.computeAllTerms(model, data, q, v)
        pin.forwardKinematics(model, data, q, v, nothing)
        pin.updateFramePlacements(model, data)
        jacobian, change = [], []
        for a, b, kind in closures:
            frames = [model.getFrameId(of) for of in (a, b)]
            at = [data.oMf[of].translation for of in frames]
            world = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
            both = [pin.computeFrameJacobian(model, data, q, of, world)[:3] for of in frames]
            moves = [pin.getFrameVelocity(model, data, of, world).linear for of in frames]
            turns = [pin.getFrameClassicalAcceleration(model, data, of, world).linear for of in frames]
            j, v_ab, a_ab = both[1] - both[0], moves[1] - moves[0], turns[1] - turns[0]
            if kind == "Distance":
                way = at[1] - at[0]
                jacobian.append(way @ j)
                change.append(way @ a_ab + v_ab @ v_ab)
            else:
                assert np.abs(at[1] - at[0]).max() < 1e-9, (a, b, at)
                jacobian.extend(j)
                change.extend(a_ab)
        return np.array(jacobian).reshape(-1, model.nv), np.array(change)

    closing, _ = rows(nothing)
    places = {of: model.joints[model.getJointId(of)].idx_v for of in solved["joints"] if model.existJointName(of)}
    chosen = np.zeros((len(rates), model.nv))
    for row, joint in enumerate(rates):
        chosen[row, places[joint]] = 1.0
    both = np.vstack([closing, chosen])
    wanted = np.concatenate([np.zeros(len(closing)), list(rates.values())])
    v, *_ = np.linalg.lstsq(both, wanted, rcond=1e-10)
    assert np.abs(both @ v - wanted).max() < 1e-7, np.abs(both @ v - wanted).max()
    closing, change = rows(v)
    mass = pin.crba(model, data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    bias = pin.nonLinearEffects(model, data, q, v)
    # q'' = p + N z with the null space N of J, where what is left of the forces does no work along N
    _, sizes, right = np.linalg.svd(closing) if len(closing) else (None, np.zeros(0), np.eye(model.nv))
    null = right[(sizes > 1e-8).sum() :].T
    part = np.linalg.lstsq(closing, -change, rcond=1e-10)[0] if len(closing) else nothing
    left = -bias - mass @ part
    free = part + null @ np.linalg.solve(null.T @ mass @ null, null.T @ left)
    return {joint: float(free[place]) for joint, place in places.items()}


def main():
    cases = [{"file": name, "rates": rates, "accelerations": accelerations(name, rates)} for name, rates in CASES.items()]
    source = f"Pinocchio {pin.__version__}, closures exact; generator: accelerations_pinocchio.py"
    print(json.dumps({"source": source, "cases": cases}, indent=1))


if __name__ == "__main__":
    main()
