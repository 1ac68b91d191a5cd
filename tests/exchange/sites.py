"""Where MuJoCo puts the sites of an MJCF file at its keyframe `home`: python sites.py others.xml > others.json

Equality constraints do not move anything there: the keyframe must obey them.
"""

import json
import sys

import mujoco

model = mujoco.MjModel.from_xml_path(sys.argv[1])
data = mujoco.MjData(model)
mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
mujoco.mj_forward(model, data)
active = [abs(x) for x, kind in zip(data.efc_pos, data.efc_type) if kind == mujoco.mjtConstraint.mjCNSTR_EQUALITY]
assert max(active, default=0) < 1e-6, active
print(json.dumps({model.site(i).name: data.site_xpos[i].tolist() for i in range(model.nsite)}, indent=1))
