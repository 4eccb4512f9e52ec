#ifndef GB_DRAW_GL_CONTEXT_H
#define GB_DRAW_GL_CONTEXT_H

#include <GL/glcorearb.h>
#include <stdbool.h>

#include "greenbody/status.h"

/* The functions of OpenGL 3.3 that the renderer calls, of the library that holds its
 * context: found by name, as two libraries in one process have functions of one name. */
/* X(type of the pointer, name without gl) */
#define GB_GL_FUNCTIONS(X)                                                               \
    X(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                             \
    X(PFNGLATTACHSHADERPROC, AttachShader)                                               \
    X(PFNGLBINDBUFFERPROC, BindBuffer)                                                   \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                         \
    X(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)                                       \
    X(PFNGLBINDTEXTUREPROC, BindTexture)                                                 \
    X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                         \
    X(PFNGLBLENDFUNCPROC, BlendFunc)                                                     \
    X(PFNGLBUFFERDATAPROC, BufferData)                                                   \
    X(PFNGLCLEARPROC, Clear)                                                             \
    X(PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                                             \
    X(PFNGLCLEARBUFFERUIVPROC, ClearBufferuiv)                                           \
    X(PFNGLCOMPILESHADERPROC, CompileShader)                                             \
    X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                             \
    X(PFNGLCREATESHADERPROC, CreateShader)                                               \
    X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                             \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                   \
    X(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                                 \
    X(PFNGLDELETESHADERPROC, DeleteShader)                                               \
    X(PFNGLDELETETEXTURESPROC, DeleteTextures)                                           \
    X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                   \
    X(PFNGLDISABLEPROC, Disable)                                                         \
    X(PFNGLDRAWARRAYSPROC, DrawArrays)                                                   \
    X(PFNGLDRAWARRAYSINSTANCEDPROC, DrawArraysInstanced)                                 \
    X(PFNGLDRAWBUFFERPROC, DrawBuffer)                                                   \
    X(PFNGLENABLEPROC, Enable)                                                           \
    X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)                         \
    X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer)                         \
    X(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)                               \
    X(PFNGLGENBUFFERSPROC, GenBuffers)                                                   \
    X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                                         \
    X(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)                                       \
    X(PFNGLGENTEXTURESPROC, GenTextures)                                                 \
    X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                                         \
    X(PFNGLGETERRORPROC, GetError)                                                       \
    X(PFNGLGETINTEGERVPROC, GetIntegerv)                                                 \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                               \
    X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                                       \
    X(PFNGLGETSHADERIVPROC, GetShaderiv)                                                 \
    X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                                   \
    X(PFNGLLINKPROGRAMPROC, LinkProgram)                                                 \
    X(PFNGLPIXELSTOREIPROC, PixelStorei)                                                 \
    X(PFNGLREADBUFFERPROC, ReadBuffer)                                                   \
    X(PFNGLREADPIXELSPROC, ReadPixels)                                                   \
    X(PFNGLRENDERBUFFERSTORAGEPROC, RenderbufferStorage)                                 \
    X(PFNGLSCISSORPROC, Scissor)                                                         \
    X(PFNGLSHADERSOURCEPROC, ShaderSource)                                               \
    X(PFNGLTEXBUFFERPROC, TexBuffer)                                                     \
    X(PFNGLTEXIMAGE2DPROC, TexImage2D)                                                   \
    X(PFNGLTEXPARAMETERIPROC, TexParameteri)                                             \
    X(PFNGLUNIFORM1FPROC, Uniform1f)                                                     \
    X(PFNGLUNIFORM1IPROC, Uniform1i)                                                     \
    X(PFNGLUNIFORM1UIPROC, Uniform1ui)                                                   \
    X(PFNGLUNIFORM2FPROC, Uniform2f)                                                     \
    X(PFNGLUNIFORM2FVPROC, Uniform2fv)                                                   \
    X(PFNGLUNIFORM2IPROC, Uniform2i)                                                     \
    X(PFNGLUNIFORM3FVPROC, Uniform3fv)                                                   \
    X(PFNGLUNIFORM4FVPROC, Uniform4fv)                                                   \
    X(PFNGLUNIFORMMATRIX3FVPROC, UniformMatrix3fv)                                       \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                                                   \
    X(PFNGLVERTEXATTRIBDIVISORPROC, VertexAttribDivisor)                                 \
    X(PFNGLVERTEXATTRIBIPOINTERPROC, VertexAttribIPointer)                               \
    X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                                 \
    X(PFNGLVIEWPORTPROC, Viewport)

#define GB_GL_MEMBER(type, name) type name;
struct gb_gl {
    GB_GL_FUNCTIONS(GB_GL_MEMBER)
};
#undef GB_GL_MEMBER

/* An OpenGL 3.3 context without a window.  The environment variable GB_GL, osmesa or egl,
 * names the library; else the first that works is taken: OSMesa, then EGL. */
struct gb_gl_context;

/* The new context is the thread's current one.  Errors: GB_ERR_MACHINE, with the reason of
 * each library; GB_ERR_INPUT: GB_GL is something else. */
bool gb_gl_context_open(struct gb_gl_context **out, struct gb_error *err);

/* Makes it the thread's current one. */
bool gb_gl_context_use(struct gb_gl_context *context, struct gb_error *err);

const struct gb_gl *gb_gl_context_functions(const struct gb_gl_context *context);

void gb_gl_context_close(struct gb_gl_context *context); /* NULL is fine */

#endif
