// The module overlook_images.so, which holds OpenImageIO: found and opened when the first picture is read or written, so that a
// command without pictures does not load OpenImageIO's libraries.
#pragma once

#include <string>

#include "formats/result.h"
#include "tools/bake/image_library.h"

namespace overlook {

// Opens the module beside the program (a build tree), else in the installed place of modules, OVERLOOK_MODULES_FROM_PROGRAMS from
// the program's folder. Nothing but the program's own place is asked, so that an installed tree may be moved. Once a process, by
// any thread; every later call returns the same. Fails with Exit::impossible (the installation is not whole: neither an input is
// wrong nor is it a bug):
//   "overlook_images.so, which reads and writes pictures, is neither in /opt/bin nor in /opt/lib/overlook; install Overlook
//    whole (cmake --install)"
//   "/opt/bin/overlook_images.so cannot be loaded: REASON OF THE LOADER; install what it names (Debian: libopenimageio2.4)"
//   "/opt/bin/overlook_images.so is of Overlook 0.0.9, this is 0.1.0; install both from one build (cmake --install)"
Result<const ImageLibrary*> image_library();

// The same for a program in `program_folder`, every time anew.
Result<const ImageLibrary*> open_image_library(const std::string& program_folder);

}  // namespace overlook
