await new Promise(done => {
    const script = document.createElement('script')
    script.src = '/node_modules/babylonjs/babylon.js'
    script.onload = done
    document.head.append(script)
})
const B = window.BABYLON, canvas = document.createElement('canvas')
let engine
export default async function draw(c, size) {
    if (engine) engine.dispose()
    const canvas = document.createElement('canvas')
    canvas.width = canvas.height = size
    engine = new B.Engine(canvas, false, { preserveDrawingBuffer: true })
    const scene = new B.Scene(engine), m = c.material, color = v => new B.Color3(...v)
    scene.useRightHandedSystem = true
    scene.clearColor = new B.Color4(0, 0, 0, 1)
    const ball = B.MeshBuilder.CreateSphere('ball', { diameter: 2, segments: 128 }, scene)
    const material = ball.material = new B.StandardMaterial('m', scene)
    material.diffuseColor = color(m.diffuse)
    material.specularColor = color(m.specular)
    material.specularPower = m.power
    if (m.emissive) material.emissiveColor = color(m.emissive)
    scene.ambientColor = color([.25, .25, .25])
    if (m.ambient) material.ambientColor = color(m.ambient)
    for (const l of c.lamps) {
        const at = new B.Vector3(l.at[0], l.at[1], l.at[2])
        const light = l.at[3] === 0 ? new B.DirectionalLight('l', at.negate(), scene)
            : l.aim ? new B.SpotLight('l', at, new B.Vector3(...l.aim).normalize(), l.angle, l.exponent, scene)
            : new B.PointLight('l', at, scene)
        if (l.range) light.range = l.range
        if (l.color) light.diffuse = light.specular = color(l.color)
    }
    const camera = new B.FreeCamera('c', new B.Vector3(0, 0, 5), scene)
    camera.setTarget(B.Vector3.Zero())
    camera.fov = Math.PI / 6
    camera.minZ = 1
    camera.maxZ = 10
    if (c.parallel) {
        camera.mode = B.Camera.ORTHOGRAPHIC_CAMERA
        camera.orthoLeft = camera.orthoBottom = -1.25
        camera.orthoRight = camera.orthoTop = 1.25
    }
    await scene.whenReadyAsync()
    scene.render()
    return canvas
}
