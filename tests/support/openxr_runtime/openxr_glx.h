#pragma once

// OpenXR with its structures for OpenGL on X11. epoxy comes first: it replaces the headers of GL and GLX.
#include <epoxy/gl.h>
#include <epoxy/glx.h>

#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_XLIB
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
#undef XR_USE_GRAPHICS_API_OPENGL
#undef XR_USE_PLATFORM_XLIB

// Names that X11 defines as macros.
#undef None
#undef Always
#undef Bool
#undef Status
#undef Success
