/* gl.c - one ball by OpenGL's fixed function, through OSMesa (Debian: libosmesa6-dev).  Reads lines
   of 30 numbers: size, parallel, ambient 3, diffuse 3, specular 3, emission 3, shininess, local
   viewer, at 4, attenuation 3, aim 3, cutoff, exponent; writes R, G, B from the top left.

   cc -O2 gl.c -lOSMesa -lm -o gl */
#include <GL/osmesa.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void ball(void)
{
    enum { RINGS = 400, SECTORS = 800 };
    const double pi = 3.14159265358979;
    for (int i = 0; i < RINGS; i++) {
        glBegin(GL_TRIANGLE_STRIP);
        for (int j = 0; j <= SECTORS; j++)
            for (int k = 0; k < 2; k++) {
                const double t = pi * (i + k) / RINGS, p = 2 * pi * j / SECTORS;
                const double x = sin(t) * cos(p), y = cos(t), z = -sin(t) * sin(p);
                glNormal3d(x, y, z);
                glVertex3d(x, y, z);
            }
        glEnd();
    }
}

int main(void)
{
    float v[30];
    OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, NULL);
    for (;;) {
        int size;
        unsigned char *pixels;
        for (int i = 0; i < 30; i++)
            if (scanf("%f", &v[i]) != 1) return 0;
        size = (int)v[0];
        pixels = malloc((size_t)size * size * 4);
        OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, size, size);
        OSMesaPixelStore(OSMESA_Y_UP, 0);
        glViewport(0, 0, size, size);
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_LIGHTING);
        glEnable(GL_LIGHT0);
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        if (v[1] != 0) glOrtho(-1.25, 1.25, -1.25, 1.25, 1, 10);
        else {
            const double t = tan(3.14159265358979 / 12);
            glFrustum(-t, t, -t, t, 1, 10);
        }
        glMatrixMode(GL_MODELVIEW);
        glLoadIdentity();
        glTranslated(0, 0, -5);
        for (int k = 0; k < 4; k++) {
            static const GLenum names[] = { GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION };
            const float color[4] = { v[2 + 3 * k], v[3 + 3 * k], v[4 + 3 * k], 1 };
            glMaterialfv(GL_FRONT_AND_BACK, names[k], color);
        }
        glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, v[14]);
        {
            const float white[4] = { 1, 1, 1, 1 }, black[4] = { 0, 0, 0, 1 };
            glLightModelfv(GL_LIGHT_MODEL_AMBIENT, white);
            glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, v[15] != 0);
            glLightfv(GL_LIGHT0, GL_AMBIENT, black);
            glLightfv(GL_LIGHT0, GL_DIFFUSE, white);
            glLightfv(GL_LIGHT0, GL_SPECULAR, white);
        }
        glLightfv(GL_LIGHT0, GL_POSITION, &v[16]);
        glLightf(GL_LIGHT0, GL_CONSTANT_ATTENUATION, v[20]);
        glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, v[21]);
        glLightf(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, v[22]);
        glLightfv(GL_LIGHT0, GL_SPOT_DIRECTION, &v[23]);
        glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, v[26]);
        glLightf(GL_LIGHT0, GL_SPOT_EXPONENT, v[27]);
        ball();
        glFinish();
        for (int i = 0; i < size * size; i++) fwrite(pixels + 4 * i, 1, 3, stdout);
        free(pixels);
    }
}
