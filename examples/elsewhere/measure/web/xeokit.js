import { Viewer, Mesh, ReadableGeometry, PhongMaterial, buildSphereGeometry, DirLight } from '/node_modules/@xeokit/xeokit-sdk/dist/xeokit-sdk.es.js'
export default async function draw(c, size) {
    const place = document.getElementById('place'), m = c.material
    place.innerHTML = `<canvas id="x" style="width:${size}px;height:${size}px"></canvas>`
    const viewer = new Viewer({ canvasId: 'x', transparent: false, backgroundColor: [0, 0, 0], antialias: false, preserveDrawingBuffer: true })
    viewer.scene.clearLights()
    for (const l of c.lamps) new DirLight(viewer.scene, { dir: l.at.slice(0, 3).map(x => -x / Math.hypot(...l.at)), color: [1, 1, 1], intensity: 1, space: 'world' })
    const camera = viewer.scene.camera
    camera.eye = [0, 0, 5]; camera.look = [0, 0, 0]; camera.up = [0, 1, 0]
    camera.perspective.fov = 30
    camera.ortho.scale = 2.5
    camera.projection = c.parallel ? 'ortho' : 'perspective'
    new Mesh(viewer.scene, {
        geometry: new ReadableGeometry(viewer.scene, buildSphereGeometry({ radius: 1, heightSegments: 180, widthSegments: 300 })),
        material: new PhongMaterial(viewer.scene, { ambient: m.ambient || [0, 0, 0], diffuse: m.diffuse, specular: m.specular, emissive: m.emissive || [0, 0, 0], shininess: m.shininess })
    })
    await new Promise(r => setTimeout(r, 250))
    viewer.scene.render(true)
    const flat = document.createElement('canvas')
    flat.width = flat.height = size
    flat.getContext('2d').drawImage(viewer.scene.canvas.canvas, 0, 0, size, size)
    viewer.destroy()
    return flat
}
