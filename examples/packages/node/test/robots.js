// Ten scenes for MuJoCo: every kind of geom, cameras, lights and materials.  drives are what actuators, of
// positions, are given in a frame.
const world = (assets, body, more = "") => `<mujoco><visual><global offwidth="640"/></visual>
<asset><texture name="sky" type="skybox" builtin="gradient" rgb1=".5 .7 .9" rgb2=".1 .15 .2" width="32" height="192"/>
<texture name="ground" type="2d" builtin="checker" rgb1=".25 .35 .45" rgb2=".15 .22 .3" width="64" height="64"/>
<material name="ground" texture="ground" texrepeat="1 1" texuniform="true"/>${assets}</asset>
<worldbody><light pos="1 -1 4" dir="-.3 .3 -1" directional="true"/>${body}</worldbody>${more}</mujoco>`;
const floor = '<geom type="plane" size="0 0 1" material="ground"/>';
const eye = (pos, x = "1 0 0 0 .5 .87") => `<camera name="eye" pos="${pos}" xyaxes="${x}" fovy="50"/>`;
const free = (pos, geoms) => `<body pos="${pos}"><freejoint/>${geoms}</body>`;
const leg = (x, y) => `<body pos="${x} ${y} 0"><joint name="hip${x}${y}" type="hinge" axis="0 1 0" range="-60 60"/>
<geom type="capsule" fromto="0 0 0 ${x / 4} 0 -.25" size=".04" rgba=".8 .5 .2 1"/><body pos="${x / 4} 0 -.25">
<joint name="knee${x}${y}" type="hinge" axis="0 1 0" range="-90 90" damping=".5"/><geom type="capsule" fromto="0 0 0 ${-x / 4} 0 -.25" size=".03" rgba=".3 .3 .35 1"/>
<geom type="sphere" size=".045" pos="${-x / 4} 0 -.25" rgba=".1 .1 .1 1"/></body></body>`;
const position = (joint, gain) => `<position joint="${joint}" kp="${gain}" kv="${gain / 10}"/>`;
const feet = [[0.3, 0.16], [0.3, -0.16], [-0.3, 0.16], [-0.3, -0.16]];
const octahedron = '<mesh name="gem" vertex="1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1.4 0 0 -1.4" scale=".25 .25 .25"/>';
const smooth = octahedron.replace("gem", "pebble").replace("/>", ' smoothnormal="true"/>');
const ring = Array.from({ length: 25 * 13 }, (_, i) => [i % 25 * Math.PI / 12, Math.floor(i / 25) * Math.PI / 6]);
const torus = `<mesh name="torus" vertex="${ring.map(([a, b]) => [(0.3 + 0.12 * Math.cos(b)) * Math.cos(a), (0.3 + 0.12 * Math.cos(b)) * Math.sin(a),
    0.12 * Math.sin(b)].map((x) => x.toFixed(4)).join(" ")).join(" ")}" texcoord="${ring.map(([a, b]) => `${(a / Math.PI).toFixed(4)} ${(b / Math.PI).toFixed(4)}`).join(" ")}"
    face="${ring.map((_, k) => (k % 25 < 24 && k < 300 ? `${k} ${k + 1} ${k + 26} ${k} ${k + 26} ${k + 25}` : "")).join(" ")}"/>`;
const hills = Array.from({ length: 144 }, (_, i) => (0.5 + 0.5 * Math.sin(i % 12 * 0.9) * Math.cos(Math.floor(i / 12) * 0.7)).toFixed(3));

export const robots = {
    kinds: world("", floor + eye("0 -4 2.4") + ["sphere .25", "capsule .15 .25", "ellipsoid .3 .2 .15",
        "cylinder .2 .25", "box .2 .25 .15"].map((g, i) => { const [type, ...size] = g.split(" ");
            return free(`${i * 0.8 - 1.6} 0 ${1 + 0.2 * i}`, `<geom type="${type}" size="${size.join(" ")}" rgba="${i % 2} .${3 + i} ${1 - i % 2} 1"/>`); }).join("")),
    pendulum: world("", floor + eye("0 -5 2.6", "1 0 0 0 .25 .97") + `<body pos="0 0 2.4"><joint type="hinge" axis="0 1 0"/>
<geom type="capsule" fromto="0 0 0 .8 0 0" size=".05" rgba=".7 .2 .2 1"/><body pos=".8 0 0"><joint type="hinge" axis="0 1 0"/>
<geom type="capsule" fromto="0 0 0 .7 0 0" size=".04" rgba=".2 .5 .7 1"/><geom type="sphere" pos=".7 0 0" size=".12" rgba=".9 .8 .2 1"/></body></body>`),
    arm: world("", floor + eye("0 -2.2 1.7") + `<geom type="box" size=".4 .4 .2" pos=".7 0 .2" rgba=".5 .4 .3 1"/>
${free(".7 0 .46", '<geom type="box" size=".05 .05 .05" rgba=".9 .2 .2 1"/>')}<body pos="-.4 0 0"><geom type="cylinder" size=".15 .1" pos="0 0 .1" rgba=".3 .3 .3 1"/>
<joint name="turn" type="hinge" axis="0 0 1" damping="2"/><body pos="0 0 .2"><joint name="lift" type="hinge" axis="0 1 0" damping="2"/><geom type="capsule" fromto="0 0 0 0 0 .6" size=".07" rgba=".9 .5 .1 1"/>
<body pos="0 0 .6"><joint name="bend" type="hinge" axis="0 1 0" damping="2"/><geom type="capsule" fromto="0 0 0 .6 0 0" size=".05" rgba=".9 .5 .1 1"/>
<body pos=".65 0 0"><geom type="box" size=".04 .12 .04" rgba=".3 .3 .3 1"/><body pos=".08 .08 0"><joint name="grip" type="slide" axis="0 1 0" range="-.06 .02"/><geom type="box" size=".08 .015 .03"/></body>
<body pos=".08 -.08 0"><joint name="grip2" type="slide" axis="0 -1 0" range="-.06 .02"/><geom type="box" size=".08 .015 .03"/></body></body></body></body></body>`,
        `<actuator>${position("turn", 60) + position("lift", 300) + position("bend", 200) + position("grip", 40) + position("grip2", 40)}</actuator>`),
    quadruped: world("", floor + eye("0 -2.5 1.5") + free("0 0 .8", '<geom type="box" size=".35 .15 .08" rgba=".2 .4 .7 1"/><geom type="ellipsoid" size=".12 .09 .08" pos=".42 0 .08" rgba=".2 .4 .7 1"/>' +
        feet.map(([x, y]) => leg(x, y)).join("")),
        `<actuator>${feet.map(([x, y]) => position(`hip${x}${y}`, 60) + position(`knee${x}${y}`, 40)).join("")}</actuator>`),
    hills: world(`<hfield name="hills" nrow="12" ncol="12" size="2 2 .6 .2" elevation="${hills.join(" ")}"/>`,
        '<geom type="hfield" hfield="hills" rgba=".35 .5 .25 1"/>' + eye("0 -5 3.2") + free("0 0 1.6", '<geom type="sphere" size=".2" rgba=".9 .3 .2 1"/>') +
        free(".7 .4 1.8", '<geom type="box" size=".15 .15 .15" rgba=".8 .8 .3 1"/>')),
    meshes: world(`${octahedron}${smooth}${torus}<texture name="rings" type="2d" builtin="checker" rgb1=".9 .8 .3" rgb2=".5 .2 .3" width="32" height="32"/><material name="rings" texture="rings"/>`,
        floor + eye("0 -3 2") + free("-.9 0 1", '<geom type="mesh" mesh="torus" material="rings" euler="60 0 0"/>') + free(".1 .4 1.3", '<geom type="mesh" mesh="torus" rgba=".5 .6 .7 1" euler="20 30 0"/>') +
        free(".9 0 .8", '<geom type="mesh" mesh="pebble" rgba=".8 .3 .6 1"/>') + free("0 -.5 .7", '<geom type="mesh" mesh="gem" rgba=".3 .7 .5 1" euler="0 50 20"/>')),
    lamps: world("", '<light pos="-1 0 2" dir="0 0 -1" diffuse=".9 .1 .1" cutoff="35" exponent="2"/><light pos="1 0 2" dir="0 0 -1" diffuse=".1 .1 .9" cutoff="35" castshadow="false"/>' +
        floor + eye("0 -4 2.4") + free("-1 0 1", '<geom type="sphere" size=".25"/>') + free("1 0 1", '<geom type="box" size=".2 .2 .2"/>'), '<visual><headlight ambient=".05 .05 .05" diffuse=".1 .1 .1"/></visual>'),
    materials: world('<material name="gold" rgba=".9 .7 .2 1" specular="1" shininess=".8"/><material name="glow" rgba=".2 .9 .4 1" emission=".8"/><material name="chalk" specular="0" rgba=".9 .9 .9 1"/><material name="glass" rgba=".4 .7 .9 .4"/>',
        floor + eye("0 -4 2.2") + ["gold", "glow", "chalk", "glass"].map((m, i) => free(`${i * 0.9 - 1.4} ${i === 3 ? -0.5 : 0} ${0.6 + 0.2 * i}`, `<geom type="sphere" size=".35" material="${m}"/>`)).join("")),
    textures: world('<texture name="dots" type="2d" builtin="checker" mark="random" markrgb="1 1 1" random=".05" rgb1=".7 .3 .2" rgb2=".5 .2 .1" width="128" height="128"/><material name="dots" texture="dots" texrepeat="2 2"/><texture name="cube" type="cube" builtin="gradient" mark="edge" markrgb="1 1 1" rgb1=".3 .6 .9" rgb2=".1 .2 .4" width="64" height="384"/><material name="cube" texture="cube"/>',
        '<geom type="plane" size="3 3 .1" material="dots"/>' + eye("0 -4 2.4") + free("-.8 0 1.2", '<geom type="box" size=".35 .35 .35" material="cube"/>') + free(".6 0 1", '<geom type="ellipsoid" size=".5 .4 .3" material="cube"/>')),
    tumble: world("", floor + eye("0 -5.5 3.4", "1 0 0 0 .42 .91") + Array.from({ length: 20 }, (_, i) => free(`${(i % 5 - 2) * 0.4} ${(i % 3 - 1) * 0.3} ${0.5 + 0.15 * i}`,
        `<geom type="${["box", "capsule", "cylinder", "sphere"][i % 4]}" size="${["0.2 0.15 0.1", "0.1 0.15", "0.14 0.12", "0.17"][i % 4]}" rgba=".${i % 9} .${9 - i % 7} .${3 + i % 6} 1"/>`)).join("")),
};

const wave = (frame, size, phase) => size * Math.sin(frame * 0.6 + phase);
export const drives = {
    arm: (frame) => [wave(frame, 0.7, 0), wave(frame, 0.2, 1), 0.2 + wave(frame, 0.25, 2), wave(frame, 0.02, 0) - 0.02, wave(frame, 0.02, 0) - 0.02],
    quadruped: (frame) => feet.flatMap((_, i) => [wave(frame, 0.4, i % 3 ? 3.14 : 0), wave(frame, 0.5, i % 3 ? 4.7 : 1.6)]),
};

// A small scene with all of it, of which examples/packages/python/test/robots.json holds one state
export const recorded = `<mujoco><asset><texture name="sky" type="skybox" builtin="gradient" rgb1=".5 .7 .9" rgb2=".1 .15 .2" width="4" height="24"/>
<texture name="ground" type="2d" builtin="checker" rgb1=".25 .35 .45" rgb2=".15 .22 .3" width="4" height="4"/><texture name="cube" type="cube" builtin="gradient" rgb1=".9 .6 .1" rgb2=".2 .1 .4" width="4" height="24"/>
<material name="ground" texture="ground" texrepeat="2 3"/><material name="cube" texture="cube" emission=".2"/>${octahedron}
<hfield name="hills" nrow="4" ncol="3" size=".6 .5 .3 .1" elevation="0 1 .2 .5 .3 .9 1 .1 .4 .2 .8 0"/></asset><worldbody>
<light pos="1 -1 4" dir="-.3 .3 -1" directional="true"/><light pos="-1 0 2" dir="0 0 -1" diffuse=".5 .1 .1" cutoff="35" exponent="2"/>
<camera name="eye" pos="0 -4 2.4" xyaxes="1 0 0 0 .5 .87" fovy="50"/><geom type="plane" size="3 2 .1" material="ground"/>
<geom type="hfield" hfield="hills" pos="1.4 .8 .1" rgba=".3 .6 .3 1"/>
${["sphere .25", "capsule .15 .25", "ellipsoid .3 .2 .15", "cylinder .2 .25", "box .2 .25 .15"].map((g, i) => { const [type, ...size] = g.split(" ");
    return free(`${i * 0.7 - 1.6} 0 ${0.6 + 0.1 * i}`, `<geom type="${type}" size="${size.join(" ")}" rgba="${i % 2} .${3 + i} ${1 - i % 2} ${i === 2 ? 0.5 : 1}" ${i === 4 ? 'material="cube"' : ""}/>`); }).join("")}
${free("-1.2 1 .8", '<geom type="mesh" mesh="gem" rgba=".8 .3 .6 1"/>')}</worldbody></mujoco>`;
