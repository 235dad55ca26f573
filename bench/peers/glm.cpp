/* glm.cpp - GLM's templates. */
#include "../maths.h"
#include <cstddef>

#ifdef HAVE_GLM
#include <glm/glm.hpp>
#include <glm/gtc/matrix_inverse.hpp>

namespace {
template <class T> const T *in(const float *p) { return reinterpret_cast<const T *>(p); }
template <class T> T *to(float *p) { return reinterpret_cast<T *>(p); }

void mat4_mat4(const float *a, const float *b, float *out, int count)
{
    for (int i = 0; i < count; i++)
        to<glm::mat4>(out)[i] = in<glm::mat4>(a)[i] * in<glm::mat4>(b)[i];
}
void mat4_vec4(const float *a, const float *b, float *out, int count)
{
    for (int i = 0; i < count; i++)
        to<glm::vec4>(out)[i] = in<glm::mat4>(a)[i] * in<glm::vec4>(b)[i];
}
void normalize(const float *a, const float *, float *out, int count)
{
    for (int i = 0; i < count; i++) to<glm::vec3>(out)[i] = glm::normalize(in<glm::vec3>(a)[i]);
}
void inverse_transpose(const float *a, const float *, float *out, int count)
{
    for (int i = 0; i < count; i++)
        to<glm::mat3>(out)[i] = glm::inverseTranspose(in<glm::mat3>(a)[i]);
}
}

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)
const maths_library *maths_glm(void)
{
    static const maths_library library = {
        "GLM " TEXT(GLM_VERSION_MAJOR) "." TEXT(GLM_VERSION_MINOR) "." TEXT(GLM_VERSION_PATCH) "."
        TEXT(GLM_VERSION_REVISION),
        mat4_mat4, mat4_vec4, normalize, inverse_transpose
    };
    return &library;
}
#else
const maths_library *maths_glm(void) { return NULL; }
#endif
