import * as pc from '/node_modules/playcanvas/build/playcanvas.mjs'
function mesh(device, rings, sectors) {
    const points = [], index = []
    for (let i = 0; i <= rings; i++)
        for (let j = 0; j < sectors; j++) {
            const t = Math.PI * i / rings, p = 2 * Math.PI * j / sectors, a = i * sectors + j, b = i * sectors + (j + 1) % sectors
            points.push(Math.sin(t) * Math.cos(p), Math.cos(t), -Math.sin(t) * Math.sin(p))
            if (i < rings) index.push(a, a + sectors, b, b, a + sectors, b + sectors)
        }
    const out = new pc.Mesh(device)
    out.setPositions(points)
    out.setNormals(points)
    out.setIndices(index)
    out.update()
    return out
}
const canvas = document.createElement('canvas')
document.getElementById('place').append(canvas)
const app = new pc.Application(canvas, { graphicsDeviceOptions: { antialias: false, preserveDrawingBuffer: true, alpha: false } })
app.autoRender = false
app.start()
const ball = mesh(app.graphicsDevice, 180, 360)
ball.incRefCount()    // else it goes with its last entity
const color = v => new pc.Color(...v)
export default function draw(c, size) {
    const m = c.material, parts = []
    const entity = (kind, options) => {
        const e = new pc.Entity()
        if (kind) e.addComponent(kind, options)
        app.root.addChild(e)
        parts.push(e)
        return e
    }
    canvas.width = canvas.height = size
    canvas.style.width = canvas.style.height = size + 'px'
    app.scene.ambientLight = color([.25, .25, .25])
    const material = new pc.StandardMaterial()
    material.diffuse = color(m.diffuse)
    material.specular = color(m.specular)
    material.emissive = color(m.emissive || [0, 0, 0])
    material.gloss = m.gloss
    material.enableGGXSpecular = !!m.ggx
    material.update()
    entity().addComponent('render', { meshInstances: [new pc.MeshInstance(ball, material)] })
    const camera = entity('camera', { clearColor: color([0, 0, 0]), nearClip: 1, farClip: 10, fov: 30, orthoHeight: 1.25,
                                      projection: c.parallel ? pc.PROJECTION_ORTHOGRAPHIC : pc.PROJECTION_PERSPECTIVE })
    camera.setPosition(0, 0, 5)
    for (const l of c.lamps) {
        const light = entity('light', { type: l.at[3] === 0 ? 'directional' : 'omni', color: color(l.color || [1, 1, 1]), intensity: 1, range: l.range || 10 })
        if (l.at[3] !== 0) light.setPosition(l.at[0], l.at[1], l.at[2])
        else {
            // its light shines along -y of the entity
            const from = new pc.Vec3(0, 1, 0), to = new pc.Vec3(l.at[0], l.at[1], l.at[2]).normalize()
            light.setRotation(new pc.Quat().setFromDirections(from, to))
        }
    }
    app.resizeCanvas(size, size)
    app.render()
    const flat = document.createElement('canvas')
    flat.width = flat.height = size
    flat.getContext('2d').drawImage(canvas, 0, 0, size, size)
    for (const e of parts) e.destroy()
    return flat
}
