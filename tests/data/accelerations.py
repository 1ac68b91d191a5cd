"""Accelerations of shipped mechanisms by MuJoCo, for tests/analyses/let_go.rs.

linkwork exports the files as MJCF. MuJoCo gives the mass matrix M, the bias c and the Jacobian J of the closures at the
keyframe `home`; with the rates asked for, q'' solves M q'' + c = J^T l and J q'' = -J' q' exactly, while MuJoCo's own
constraints are soft. J' q' is a difference of fourth order.

    python3 tests/data/accelerations.py LINKWORK > tests/data/accelerations.json     (pip install mujoco numpy)
"""

import json
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np

FOLDER = Path(__file__).resolve().parents[2] / "mechanisms" / "loads"
CASES = {
    "four_bar_let_go": {"theta": 3.0},
    "balanced_four_bar": {"theta1": -2.0},
    "four_bar_flywheel": {"theta1": 5.0},
    "trebuchet": {"beam": 0.7, "hanger": -0.4, "sling": 1.1},
    "desk_lamp": {"a": 0.8, "b": -1.3},
    "andrews_squeezer": {"beta": 4.0},
    "wishbone": {"lower": 1.5},
    "flyball_governor": {"spin": 2.0, "left": 0.5, "right": 0.5, "s": -0.3},
    "engine": {"theta": 10.0},
}


def jacobian(model, data, qpos):
    data.qpos[:] = qpos
    mujoco.mj_fwdPosition(model, data)
    rows = data.efc_J.reshape(-1, model.nv)
    return rows[np.array(data.efc_type[: data.nefc]) == mujoco.mjtConstraint.mjCNSTR_EQUALITY].copy()


def accelerations(text, rates):
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    home = data.qpos.copy()
    names = [model.joint(i).name for i in range(model.njnt)]
    closing = jacobian(model, data, home)
    chosen = np.zeros((len(rates), model.nv))
    for row, name in enumerate(rates):
        chosen[row, model.jnt_dofadr[names.index(name)]] = 1.0
    both = np.vstack([closing, chosen])
    wanted = np.concatenate([np.zeros(len(closing)), list(rates.values())])
    v, *_ = np.linalg.lstsq(both, wanted, rcond=1e-10)
    assert np.abs(both @ v - wanted).max() < 1e-7, np.abs(both @ v - wanted).max()
    change = np.zeros(len(closing))
    step = 1e-4 / np.abs(v).max()
    for steps, weight in ((-2, 1), (-1, -8), (1, 8), (2, -1)):
        moved = home.copy()
        mujoco.mj_integratePos(model, moved, v, steps * step)
        change += weight * (jacobian(model, data, moved) @ v) / (12 * step)
    data.qpos[:], data.qvel[:] = home, v
    mujoco.mj_fwdPosition(model, data)
    mujoco.mj_fwdVelocity(model, data)
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    # q'' = p + N z with the null space N of J, where what is left of the forces does no work along N
    _, sizes, rows = np.linalg.svd(closing) if len(closing) else (None, np.zeros(0), np.eye(model.nv))
    null = rows[(sizes > 1e-8).sum() :].T
    part = np.linalg.lstsq(closing, -change, rcond=1e-10)[0] if len(closing) else np.zeros(model.nv)
    left = -data.qfrc_bias - mass @ part
    free = part + null @ np.linalg.solve(null.T @ mass @ null, null.T @ left)
    return {name: float(free[model.jnt_dofadr[i]]) for i, name in enumerate(names) if model.jnt_type[i] >= 2}


def main():
    cases = []
    for name, rates in CASES.items():
        file = FOLDER / f"{name}.ron"
        text = subprocess.run([sys.argv[1], "export", file, "--to", "mjcf"], capture_output=True, text=True, check=True)
        found = accelerations(text.stdout, rates)
        cases.append({"file": name, "rates": rates, "accelerations": found})
    source = f"MuJoCo {mujoco.__version__}, closures exact; generator: accelerations.py"
    print(json.dumps({"source": source, "cases": cases}, indent=1))


if __name__ == "__main__":
    main()
