import * as THREE from 'three'
import { MTLLoader } from '/node_modules/three/examples/jsm/loaders/MTLLoader.js'
const color = c => new THREE.Color().setRGB(...c)
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true })
const shape = new THREE.SphereGeometry(1, 360, 180)
function mtl(m) {
    const text = `newmtl m\nKd ${m.Kd.join(' ')}\nKs ${m.Ks.join(' ')}\nKe ${(m.Ke || [0, 0, 0]).join(' ')}\nNs ${m.Ns}\nillum ${m.illum}\n`
    const made = new MTLLoader().parse(text, '')
    made.preload()
    return made.materials.m
}
const makes = {
    three_mtl: mtl,
    three_phong: m => new THREE.MeshPhongMaterial({ color: color(m.color), specular: color(m.specular), shininess: m.shininess,
                                                    emissive: color(m.emissive || [0, 0, 0]) }),
    three_toon: m => new THREE.MeshToonMaterial({ color: color(m.color) }),
    three_lambert: m => new THREE.MeshLambertMaterial({ color: color(m.color) })
}
export default function draw(c, size) {
    renderer.setSize(size, size)
    const scene = new THREE.Scene()
    scene.add(new THREE.Mesh(shape, makes[c.program](c.material)))
    for (const l of c.lamps) {
        const tint = color(l.color || [1, 1, 1])
        let light
        if (l.at[3] === 0) light = new THREE.DirectionalLight(tint, l.intensity)
        else if (l.aim) {
            light = new THREE.SpotLight(tint, l.intensity, l.distance || 0, l.angle, l.penumbra, l.decay)
            light.target.position.set(l.at[0] + l.aim[0], l.at[1] + l.aim[1], l.at[2] + l.aim[2])
            scene.add(light.target)
        } else light = new THREE.PointLight(tint, l.intensity, l.distance || 0, l.decay)
        light.position.set(...l.at)
        scene.add(light)
    }
    scene.add(new THREE.AmbientLight(0xffffff, .25))
    const camera = c.parallel ? new THREE.OrthographicCamera(-1.25, 1.25, 1.25, -1.25, 1, 10) : new THREE.PerspectiveCamera(30, 1, 1, 10)
    camera.position.set(0, 0, 5)
    renderer.render(scene, camera)
    return renderer.domElement
}
