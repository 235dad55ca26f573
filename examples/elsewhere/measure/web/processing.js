await new Promise(done => {
    const script = document.createElement('script')
    script.src = '/node_modules/processing-js/processing.js'
    script.onload = done
    document.head.append(script)
})
const bytes = v => v.map(x => 255 * x)
export default async function draw(c, size) {
    const m = c.material, canvas = document.createElement('canvas')
    document.getElementById('place').replaceChildren(canvas)
    const sketch = new window.Processing(canvas, p => {
        p.setup = () => {
            p.size(size, size, p.P3D)
            p.noLoop()
        }
        p.draw = () => {
            p.background(0)
            // its y is down
            if (c.parallel) p.ortho(-1.25, 1.25, -1.25, 1.25, 1, 10)
            else p.perspective(Math.PI / 6, 1, 1, 10)
            p.camera(0, 0, 5, 0, 0, 0, 0, 1, 0)
            p.noLights()
            p.ambientLight(64, 64, 64)
            for (const l of c.lamps) {
                p.lightFalloff(...(l.attenuation || [1, 0, 0]))
                p.lightSpecular(...bytes(l.color || [1, 1, 1]))
                const tint = bytes(l.color || [1, 1, 1])
                if (l.at[3] === 0) p.directionalLight(...tint, -l.at[0], l.at[1], -l.at[2])
                else if (l.aim) p.spotLight(...tint, l.at[0], -l.at[1], l.at[2], l.aim[0], -l.aim[1], l.aim[2], l.angle, l.concentration)
                else p.pointLight(...tint, l.at[0], -l.at[1], l.at[2])
            }
            p.noStroke()
            p.fill(...bytes(m.fill))
            p.ambient(...bytes(m.ambient))
            p.specular(...bytes(m.specular))
            p.emissive(...bytes(m.emissive || [0, 0, 0]))
            p.shininess(m.shininess)
            p.sphereDetail(250, 250)
            p.sphere(1)
        }
    })
    const flat = document.createElement('canvas')
    flat.width = flat.height = size
    flat.getContext('2d').drawImage(canvas, 0, 0, size, size)
    sketch.exit()
    return flat
}
