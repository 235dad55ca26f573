await new Promise(done => {
    const script = document.createElement('script')
    script.src = '/node_modules/p5/lib/p5.js'
    script.onload = done
    document.head.append(script)
})
export default async function draw(c, size) {
    const m = c.material
    return new Promise(done => {
        const sketch = new window.p5(p => {
            p.setup = () => {
                p.pixelDensity(1)
                p.setAttributes('antialias', false)
                p.createCanvas(size, size, p.WEBGL)
                p.noLoop()
            }
            p.draw = () => {
                p.background(0)
                // p5's y is down
                if (c.parallel) p.ortho(-1.25, 1.25, -1.25, 1.25, 1, 10)
                else p.perspective(Math.PI / 6, 1, 1, 10)
                p.camera(0, 0, 5, 0, 0, 0, 0, 1, 0)
                for (const l of c.lamps) {
                    if (l.attenuation) p.lightFalloff(...l.attenuation)
                    if (l.at[3] === 0) p.directionalLight(255, 255, 255, -l.at[0], l.at[1], -l.at[2])
                    else p.pointLight(255, 255, 255, l.at[0], -l.at[1], l.at[2])
                }
                p.noStroke()
                p.fill(...m.fill.map(x => 255 * x))
                if (m.specular) p.specularMaterial(...m.specular.map(x => 255 * x))
                if (m.specular) p.fill(...m.fill.map(x => 255 * x))
                p.shininess(m.shininess)
                p.sphere(1, 200, 100)
                const flat = document.createElement('canvas')
                flat.width = flat.height = size
                flat.getContext('2d').drawImage(p.drawingContext.canvas, 0, 0)
                setTimeout(() => { sketch.remove(); done(flat) }, 0)
            }
        })
    })
}
