#ifndef GB_DRAW_GL_CAMERA_H
#define GB_DRAW_GL_CAMERA_H

/* Camera of a rendering pass in the form of the shaders' uniform variables. */
struct gb_camera {
    float projection[4];  /* axis x and y, focal length in samples; 1: no perspective */
    float depth_range[2]; /* depth of 0 and of 1 in the depth buffer */
    float rotation[9],
        translation[3]; /* from the scene's coordinates; matrix by columns */
};

#endif
