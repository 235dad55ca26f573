/* irrlicht.cpp - one ball by Irrlicht's Burning's Video without a window (Debian: libirrlicht-dev).
   Reads 11 numbers: size, parallel, diffuse 3, emission 3, at 3 of a lamp at infinity; writes R, G,
   B from the top left.

   c++ -O2 irrlicht.cpp -lIrrlicht -o irrlicht */
#include <irrlicht/irrlicht.h>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>

using namespace irr;

int main()
{
    float v[11];
    for (float &n : v)
        if (std::scanf("%f", &n) != 1) return 1;
    const u32 size = u32(v[0]);
    const int out = dup(1); /* its console device and its log write to standard output */
    dup2(2, 1);
    SIrrlichtCreationParameters with;
    with.DeviceType = EIDT_CONSOLE;
    with.DriverType = video::EDT_BURNINGSVIDEO;
    with.WindowSize = core::dimension2d<u32>(size, size);
    with.LoggingLevel = ELL_NONE;
    IrrlichtDevice *device = createDeviceEx(with);
    if (!device) return 1;
    video::IVideoDriver *driver = device->getVideoDriver();
    scene::ISceneManager *scene = device->getSceneManager();
    /* its world is left-handed: z is turned */
    scene::ISceneNode *ball = scene->addSphereSceneNode(1, 128);
    video::SMaterial &m = ball->getMaterial(0);
    m.ColorMaterial = video::ECM_NONE;
    m.AmbientColor = video::SColor(255, 0, 0, 0);
    m.DiffuseColor = video::SColorf(v[2], v[3], v[4]).toSColor();
    m.SpecularColor = video::SColor(255, 204, 204, 204); /* which it does not draw */
    m.EmissiveColor = video::SColorf(v[5], v[6], v[7]).toSColor();
    m.Shininess = 30;
    m.Lighting = true;
    scene->setAmbientLight(video::SColorf(0, 0, 0));
    scene::ILightSceneNode *lamp = scene->addLightSceneNode();
    video::SLight light = lamp->getLightData();
    light.Type = video::ELT_DIRECTIONAL;
    light.DiffuseColor = light.SpecularColor = video::SColorf(1, 1, 1);
    light.AmbientColor = video::SColorf(0, 0, 0);
    lamp->setLightData(light);
    lamp->setRotation(core::vector3df(-v[8], -v[9], v[10]).getHorizontalAngle());
    scene::ICameraSceneNode *camera =
        scene->addCameraSceneNode(0, core::vector3df(0, 0, -5), core::vector3df(0, 0, 0));
    core::matrix4 projection;
    if (v[1] != 0)
        projection.buildProjectionMatrixOrthoLH(2.5f, 2.5f, 1, 10);
    else
        projection.buildProjectionMatrixPerspectiveFovLH(core::PI / 6, 1, 1, 10);
    camera->setProjectionMatrix(projection, v[1] != 0);
    for (int frame = 0; frame < 2; frame++) {
        driver->beginScene(true, true, video::SColor(255, 0, 0, 0));
        scene->drawAll();
        video::IImage *picture = frame ? driver->createScreenShot() : nullptr;
        for (u32 i = 0; picture && i < size * size; i++) {
            const video::SColor c = picture->getPixel(i % size, i / size);
            const unsigned char rgb[3] = { (unsigned char)c.getRed(), (unsigned char)c.getGreen(),
                                           (unsigned char)c.getBlue() };
            if (write(out, rgb, 3) != 3) return 1;
        }
        if (!frame) driver->endScene();
    }
    std::_Exit(0);
}
