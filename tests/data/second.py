"""The first second of shipped mechanisms that are let go, by MuJoCo, for tests/analyses/let_go.rs.

linkwork exports the files as MJCF, with the step, the integrator and the stiffness of closures that MuJoCo needs to keep
them closed. Motors are off; springs and given forces of the files are not part of the exported ones.

    python3 tests/data/second.py LINKWORK > tests/data/second.json     (pip install mujoco)
"""

import json
import subprocess
import sys
from pathlib import Path

import mujoco

FOLDER = Path(__file__).resolve().parents[2] / "mechanisms" / "loads"
CASES = ["four_bar_let_go", "four_bar_flywheel", "trebuchet", "flyball_governor"]
TIMES = [0.25, 0.5, 0.75, 1.0]


def second(text):
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ACTUATION
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_LIMIT
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    names = {model.joint(i).name: model.jnt_qposadr[i] for i in range(model.njnt) if model.jnt_type[i] >= 2}
    rows = []
    for time in TIMES:
        while data.time < time - 0.5 * model.opt.timestep:
            mujoco.mj_step(model, data)
        rows.append([time, *(float(data.qpos[place]) for place in names.values())])
    return list(names), rows


def main():
    cases = []
    for name in CASES:
        file = FOLDER / f"{name}.ron"
        text = subprocess.run([sys.argv[1], "export", file, "--to", "mjcf"], capture_output=True, text=True, check=True)
        joints, rows = second(text.stdout)
        cases.append({"file": name, "joints": joints, "rows": rows})
    print(json.dumps({"source": f"MuJoCo {mujoco.__version__}; generator: second.py", "cases": cases}, indent=1))


if __name__ == "__main__":
    main()
