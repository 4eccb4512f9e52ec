#ifndef GB_DRAW_GL_GL_FUNCTIONS_H
#define GB_DRAW_GL_GL_FUNCTIONS_H

/* The functions of OpenGL 3.3 that the renderer calls, of the library that holds its
 * context: found by name, as two libraries in one process have functions of one name. */
#include <GL/glcorearb.h>

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

#endif
