/* coin.cpp - draws an Open Inventor file by Coin through OSMesa (Debian: libcoin-dev,
   libosmesa6-dev): coin SIZE, the file on standard input; writes R, G, B from the top left.

   c++ -O2 coin.cpp -lOSMesa -lCoin -o coin            OSMesa first: Coin then draws by it */
#include <GL/osmesa.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInteraction.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/nodes/SoSeparator.h>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

int main(int, char **argv)
{
    const int size = std::atoi(argv[1]);
    std::vector<unsigned char> pixels(4 * size * size);
    std::string text;
    char part[4096];
    for (size_t n; (n = std::fread(part, 1, sizeof part, stdin)) > 0;) text.append(part, n);
    OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
    OSMesaMakeCurrent(context, pixels.data(), GL_UNSIGNED_BYTE, size, size);
    OSMesaPixelStore(OSMESA_Y_UP, 0);
    setenv("COIN_VERTEX_ARRAYS", "0", 1); /* it would look for them in libGL, not here */
    SoDB::init();
    SoInteraction::init();
    SoInput in;
    in.setBuffer(&text[0], text.size());
    SoSeparator *root = SoDB::readAll(&in);
    if (!root) return 1;
    root->ref();
    glEnable(GL_DEPTH_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    SoGLRenderAction action(SbViewportRegion(size, size));
    action.apply(root);
    glFinish();
    for (int i = 0; i < size * size; i++) std::fwrite(&pixels[4 * i], 1, 3, stdout);
    std::fflush(stdout);
    std::_Exit(0);
}
