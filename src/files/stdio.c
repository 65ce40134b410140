/* Files that are read. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

/* Open a file for reading; NULL if that fails. A named pipe is opened once there is something in
 * it, and not only when somebody writes: who wrote all of it may have gone. So this is a writer
 * itself while the pipe is opened. */
FILE *files_open_input(const char *path)
{
    struct pollfd pipe = { .events = POLLIN };
    struct stat about;
    FILE *stream = NULL;
    int ready, writer;

    if (stat(path, &about) != 0 || !S_ISFIFO(about.st_mode))
        return fopen(path, "r");
    pipe.fd = open(path, O_RDONLY | O_NONBLOCK);
    if (pipe.fd < 0)
        return NULL;
    do
        ready = poll(&pipe, 1, -1);
    while (ready < 0 && errno == EINTR);
    writer = ready > 0 ? open(path, O_WRONLY | O_NONBLOCK) : -1;
    if (writer >= 0) {
        stream = fopen(path, "r");
        close(writer);
    }
    close(pipe.fd);
    return stream;
}
