"""What MuJoCo finds at the keyframe `home` of exported files.

Reads {name: {"mjcf": text, "frames": {site: [x, y, z]}, "nudge": radians}} from stdin; writes for each the largest
violation of an equality constraint, the largest distance of a site from where it should be, and how many freedoms the
constraints leave: the velocities less the rank of their Jacobian.
"""

import json
import sys

import mujoco
import numpy as np


def report(job):
    model = mujoco.MjModel.from_xml_string(job["mjcf"])
    model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    if model.nq:
        data.qpos[0] += job.get("nudge", 0.0)
    mujoco.mj_forward(model, data)
    equality = [i for i in range(data.nefc) if data.efc_type[i] == mujoco.mjtConstraint.mjCNSTR_EQUALITY]
    gaps = [abs(data.efc_pos[i]) for i in equality]
    # constraints that nothing moves are left out of the rows but not of the memory
    rows = data.efc_J[: data.nefc * model.nv].reshape(data.nefc, model.nv)
    jacobian = rows[equality]
    values = np.linalg.svd(jacobian, compute_uv=False) if jacobian.size else np.zeros(0)
    rank = int(np.sum(values > 1e-7 * values[0])) if values.size and values[0] > 0 else 0
    apart = [0.0]
    for site, place in job["frames"].items():
        apart.append(float(np.linalg.norm(data.site(site).xpos - np.array(place))))
    outside = [0.0]
    for joint in range(model.njnt):
        if model.jnt_limited[joint]:
            value = data.qpos[model.jnt_qposadr[joint]]
            low, high = model.jnt_range[joint]
            outside.append(float(max(low - value, value - high)))
    return {
        "gap": float(max(gaps, default=0.0)),
        "sites": max(apart),
        "outside": max(outside),
        "freedoms": model.nv - rank,
        "constraints": len(equality),
    }


print(json.dumps({name: report(job) for name, job in json.load(sys.stdin).items()}))
