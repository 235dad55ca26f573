const vec = v => v.slice(0, 3).join(' ')
await new Promise(done => {
    const script = document.createElement('script')
    script.src = '/node_modules/x3dom/x3dom.js'
    script.onload = done
    document.head.append(script)
})
const frames = async n => { for (let i = 0; i < n; i++) await new Promise(requestAnimationFrame) }
export default async function draw(c, size) {
    const m = c.material
    const lights = c.lamps.map(l => l.at[3] === 0
        ? `<DirectionalLight direction="${vec(l.at.map(x => -x))}" color="1 1 1" intensity="1"></DirectionalLight>`
        : `<PointLight location="${vec(l.at)}" attenuation="${(l.attenuation || [1, 0, 0]).join(' ')}" radius="100"></PointLight>`).join('')
    const view = c.parallel ? '<OrthoViewpoint position="0 0 5" orientation="0 0 1 0" fieldOfView="-1.25 -1.25 1.25 1.25" zNear="1" zFar="10"></OrthoViewpoint>'
        : `<Viewpoint position="0 0 5" fieldOfView="${Math.PI / 6}" zNear="1" zFar="10"></Viewpoint>`
    const place = document.getElementById('place')
    place.innerHTML = `<x3d width="${size}px" height="${size}px" style="border:none;padding:0"><scene DEF="s">
        <NavigationInfo headlight="false" type='"NONE"'></NavigationInfo><Environment></Environment>${view}${lights}
        <Shape><Appearance><Material diffuseColor="${m.diffuseColor.join(' ')}" specularColor="${(m.specularColor || [0, 0, 0]).join(' ')}"
        emissiveColor="${(m.emissiveColor || [0, 0, 0]).join(' ')}" shininess="${m.shininess}" ambientIntensity="0"></Material></Appearance>
        <Sphere radius="1" subdivision="256,256"></Sphere></Shape></scene></x3d>`
    window.x3dom.reload()
    await frames(12)
    const canvas = place.querySelector('canvas'), runtime = place.querySelector('x3d').runtime
    runtime.canvas.doc.needRender = true
    const url = runtime.getScreenshot()
    const image = new Image()
    image.src = url
    await image.decode()
    const out = document.createElement('canvas')
    out.width = out.height = size
    out.getContext('2d').drawImage(image, 0, 0)
    place.innerHTML = ''
    return out
}
