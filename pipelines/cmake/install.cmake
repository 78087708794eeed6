# What `cmake --install` puts down; find_package(overlook) finds it.
