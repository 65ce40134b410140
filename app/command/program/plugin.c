/* Libraries that are loaded only when they are needed. */
#define _XOPEN_SOURCE 700
#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* HDF5, which a library may rest on, closes at the end of the program what is still open, and
 * faults where a full disk kept a file from being closed. */
static void stay_silent(void *loaded)
{
    int (*dont_atexit)(void) = NULL;
    void *found = dlsym(loaded, "H5dont_atexit");

    if (found) {
        memcpy(&dont_atexit, &found, sizeof dont_atexit);
        dont_atexit();
    }
}

/* A procedure of a library that lies beside the program or, once that is installed, in
 * ../lib/faststrip. Null with a reason if there is none. */
void (*faststrip_load(const char *library, const char *procedure, char *why, int capacity))(void)
{
    char program[PATH_MAX], path[PATH_MAX + 64], *slash;
    ssize_t n = readlink("/proc/self/exe", program, sizeof program - 1);
    void *loaded, *found = NULL;
    void (*called)(void) = NULL;

    program[n > 0 ? n : 0] = '\0';
    slash = strrchr(program, '/');
    if (slash)
        slash[1] = '\0';
    snprintf(path, sizeof path, "%s%s", program, library);
    if (access(path, F_OK) != 0)
        snprintf(path, sizeof path, "%s../lib/faststrip/%s", program, library);
    loaded = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (loaded) {
        stay_silent(loaded);
        found = dlsym(loaded, procedure);
    }
    if (found)
        memcpy(&called, &found, sizeof called);
    else
        snprintf(why, (size_t)capacity, "%s", dlerror());
    return called;
}
