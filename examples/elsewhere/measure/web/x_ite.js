import X3D from '/node_modules/x_ite/dist/x_ite.min.mjs'
const vec = v => v.slice(0, 3).join(' ')
const frames = async n => { for (let i = 0; i < n; i++) await new Promise(requestAnimationFrame) }
// X_ITE's own Sphere has fewer faces
function mesh(rings, sectors) {
    const points = [], index = []
    for (let i = 0; i <= rings; i++)
        for (let j = 0; j < sectors; j++) {
            const t = Math.PI * i / rings, p = 2 * Math.PI * j / sectors, a = i * sectors + j, b = i * sectors + (j + 1) % sectors
            points.push([Math.sin(t) * Math.cos(p), Math.cos(t), -Math.sin(t) * Math.sin(p)].map(x => x.toFixed(6)).join(' '))
            if (i < rings) index.push(a, a + sectors, b, b, a + sectors, b + sectors)
        }
    const list = points.join(', ')
    return `geometry IndexedTriangleSet { index [ ${index.join(' ')} ] coord Coordinate { point [ ${list} ] } normal Normal { vector [ ${list} ] } }`
}
const ball = mesh(120, 240)
let element
export default async function draw(c, size) {
    const m = c.material
    const lights = c.lamps.map(l => l.at[3] === 0
        ? `DirectionalLight { direction ${vec(l.at.map(x => -x))} }`
        : l.aim ? `SpotLight { location ${vec(l.at)} direction ${vec(l.aim)} beamWidth ${l.beamWidth} cutOffAngle ${l.cutOffAngle} radius 100 }`
        : `PointLight { location ${vec(l.at)} attenuation ${(l.attenuation || [1, 0, 0]).join(' ')} radius ${l.radius || 100} }`).join('\n')
    const view = c.parallel ? 'OrthoViewpoint { position 0 0 5 fieldOfView [ -1.25 -1.25 1.25 1.25 ] }' : `Viewpoint { position 0 0 5 fieldOfView ${Math.PI / 6} }`
    const text = `#X3D V4.0 utf8
PROFILE Interchange
COMPONENT Lighting:2
COMPONENT Navigation:3
NavigationInfo { headlight FALSE type "NONE" }
${view}
${lights}
Shape { appearance Appearance { material Material { diffuseColor ${m.diffuseColor.join(' ')} specularColor ${(m.specularColor || [0, 0, 0]).join(' ')}
emissiveColor ${(m.emissiveColor || [0, 0, 0]).join(' ')} shininess ${m.shininess} ambientIntensity 0 } } ${ball} }`
    if (element) element.remove()
    const place = document.getElementById('place')
    place.innerHTML = `<x3d-canvas preserveDrawingBuffer="true" style="width:${size}px;height:${size}px;border:none;display:block"></x3d-canvas>`
    element = place.firstChild
    await frames(2)
    const browser = element.browser
    browser.setBrowserOption('Antialiased', false)
    browser.setBrowserOption('PrimitiveQuality', 'HIGH')
    browser.setBrowserOption('ContentScale', 1)
    browser.getBrowserOptions && (browser.getBrowserOptions().SplashScreen = false)
    await browser.replaceWorld(await browser.createX3DFromString(text))
    await frames(8)
    const image = new Image()
    image.src = element.toDataURL()
    await image.decode()
    const out = document.createElement('canvas')
    out.width = out.height = size
    out.getContext('2d').drawImage(image, 0, 0, size, size)
    return out
}
