"""Where MuJoCo puts the links of a URDF file at joint values.

python places.py arm.urdf '{"pan": 0.3}' prints {link: [x, y, z, w, i, j, k]}; so were made the numbers of arm.json.
Joints that mimic others must be given their values too: MuJoCo does not set them.
"""

import json
import sys

import mujoco

path, values = sys.argv[1], json.loads(sys.argv[2])
text = open(path).read()
# meshes are not there, and links fixed to others are to stay
start = text.index("<robot")
end = text.index(">", start) + 1
text = text[:end] + '<mujoco><compiler fusestatic="false" discardvisual="true"/></mujoco>' + text[end:]
while "<visual>" in text:
    text = text[: text.index("<visual>")] + text[text.index("</visual>") + len("</visual>") :]
model = mujoco.MjModel.from_xml_string(text)
data = mujoco.MjData(model)
for joint, value in values.items():
    data.joint(joint).qpos = value
mujoco.mj_kinematics(model, data)
places = {}
for body in range(1, model.nbody):
    places[model.body(body).name] = [*data.xpos[body].tolist(), *data.xquat[body].tolist()]
print(json.dumps({"joints": values, "links": places}, indent=1))
