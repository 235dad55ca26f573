/* osg.cpp - one ball by OpenSceneGraph's state, through OSMesa (Debian: libopenscenegraph-dev,
   libosmesa6-dev).  Reads 27 numbers: size, parallel, ambient 3, diffuse 3, specular 3, emission 3,
   shininess, at 4, attenuation 3, aim 3, cutoff, exponent; writes R, G, B from the top left.

   c++ -O2 osg.cpp -lOSMesa -losgViewer -losgUtil -losgGA -losg -o osg        OSMesa first */
#include <GL/osmesa.h>
#include <osg/Geode>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/ShapeDrawable>
#include <osgViewer/Viewer>
#include <cstdio>
#include <vector>

static osg::Vec4 color(const float *v) { return osg::Vec4(v[0], v[1], v[2], 1); }

int main()
{
    float v[27];
    for (float &n : v)
        if (std::scanf("%f", &n) != 1) return 1;
    const int size = int(v[0]);
    std::vector<unsigned char> pixels(4 * size * size);
    OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
    OSMesaMakeCurrent(context, pixels.data(), GL_UNSIGNED_BYTE, size, size);
    OSMesaPixelStore(OSMESA_Y_UP, 0);

    osg::ref_ptr<osg::TessellationHints> fine = new osg::TessellationHints;
    fine->setDetailRatio(8);
    osg::ref_ptr<osg::Geode> ball = new osg::Geode;
    ball->addDrawable(new osg::ShapeDrawable(new osg::Sphere(osg::Vec3(), 1), fine));
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, color(v + 2));
    material->setDiffuse(osg::Material::FRONT_AND_BACK, color(v + 5));
    material->setSpecular(osg::Material::FRONT_AND_BACK, color(v + 8));
    material->setEmission(osg::Material::FRONT_AND_BACK, color(v + 11));
    material->setShininess(osg::Material::FRONT_AND_BACK, v[14]);
    ball->getOrCreateStateSet()->setAttributeAndModes(material);

    osg::ref_ptr<osg::Light> light = new osg::Light(1);
    light->setPosition(osg::Vec4(v[15], v[16], v[17], v[18]));
    light->setDiffuse(osg::Vec4(1, 1, 1, 1));
    light->setSpecular(osg::Vec4(1, 1, 1, 1));
    light->setAmbient(osg::Vec4(0, 0, 0, 1));
    light->setConstantAttenuation(v[19]);
    light->setLinearAttenuation(v[20]);
    light->setQuadraticAttenuation(v[21]);
    light->setDirection(osg::Vec3(v[22], v[23], v[24]));
    if (v[25] > 0) light->setSpotCutoff(v[25]);
    light->setSpotExponent(v[26]);
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(light);

    osg::ref_ptr<osg::Group> root = new osg::Group;
    source->addChild(ball);
    root->addChild(source);
    root->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    root->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);

    osgViewer::Viewer viewer;
    viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    viewer.setUpViewerAsEmbeddedInWindow(0, 0, size, size);
    viewer.setLightingMode(osg::View::NO_LIGHT);
    viewer.setSceneData(root);
    viewer.getCamera()->setClearColor(osg::Vec4(0, 0, 0, 1));
    viewer.getCamera()->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    viewer.getCamera()->setViewMatrixAsLookAt(osg::Vec3(0, 0, 5), osg::Vec3(), osg::Vec3(0, 1, 0));
    if (v[1] != 0)
        viewer.getCamera()->setProjectionMatrixAsOrtho(-1.25, 1.25, -1.25, 1.25, 1, 10);
    else
        viewer.getCamera()->setProjectionMatrixAsPerspective(30, 1, 1, 10);
    viewer.realize();
    viewer.frame();
    glFinish();
    for (int i = 0; i < size * size; i++) std::fwrite(&pixels[4 * i], 1, 3, stdout);
    std::fflush(stdout);
    std::_Exit(0);
}
