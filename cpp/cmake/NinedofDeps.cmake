# Where Eigen, NLopt and threads come from. Nothing is downloaded here.

# PyPI's cmeel-* packages keep their files under <site-packages>/cmeel.prefix; scikit-build-core already puts
# <site-packages> on the prefix path.
foreach(_prefix IN LISTS CMAKE_PREFIX_PATH)
  if(IS_DIRECTORY "${_prefix}/cmeel.prefix")
    list(APPEND CMAKE_PREFIX_PATH "${_prefix}/cmeel.prefix")
  endif()
endforeach()

find_package(Eigen3 CONFIG QUIET) # without a version: a request for 3.4 refuses Eigen 5
if(NOT Eigen3_FOUND)
  message(FATAL_ERROR "Eigen not found: apt-get install libeigen3-dev, brew install eigen, or conda install -c conda-forge eigen")
endif()
if(Eigen3_VERSION VERSION_LESS 3.4)
  message(FATAL_ERROR "Eigen 3.4 or newer needed, found ${Eigen3_VERSION} in ${Eigen3_DIR}")
endif()

# Debian's libnlopt-cxx-dev brings a second package file with only NLopt::nlopt_cxx; sorted by name the plain one comes first.
set(CMAKE_FIND_PACKAGE_SORT_ORDER NAME)
set(CMAKE_FIND_PACKAGE_SORT_DIRECTION ASC)
find_package(NLopt 2.7 CONFIG QUIET)
if(NOT TARGET NLopt::nlopt AND TARGET NLopt::nlopt_cxx)
  add_library(NLopt::nlopt ALIAS NLopt::nlopt_cxx)
endif()
if(NOT TARGET NLopt::nlopt)
  message(FATAL_ERROR "NLopt 2.7 or newer not found: apt-get install libnlopt-dev, brew install nlopt, or conda install -c conda-forge nlopt")
endif()

find_package(Threads REQUIRED)

# pip builds with headers in a folder of a random name, and to a compiler cache a header at another path is another one.
# With ccache the headers of a target are read through a link, at the same path below each build folder.
# The version is part of the path, so that other headers change the command line.
function(ninedof_read_through_link target version)
  get_target_property(folder ${target} INTERFACE_INCLUDE_DIRECTORIES)
  if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache" AND IS_DIRECTORY "${folder}"
     AND NOT folder IN_LIST CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES)
    string(MAKE_C_IDENTIFIER "${target} ${version}" name)
    set(link "${PROJECT_BINARY_DIR}/headers/${name}")
    file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/headers")
    file(CREATE_LINK "${folder}" "${link}" SYMBOLIC)
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${link}")
  endif()
endfunction()
ninedof_read_through_link(Eigen3::Eigen "${Eigen3_VERSION}")
