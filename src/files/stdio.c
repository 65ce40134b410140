/* Files that are read. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

/* Open a file for reading; NULL if that fails. A named pipe is opened without waiting for a second
 * writer: the first one may have written all and gone while what it wrote is kept by another
 * opening of the pipe. Then something has to be in it. */
FILE *faststrip_open_input(const char *path)
{
    struct pollfd pipe = { .events = POLLIN };
    struct stat about;
    FILE *stream = NULL;
    int ready;

    if (stat(path, &about) != 0 || !S_ISFIFO(about.st_mode))
        return fopen(path, "r");
    pipe.fd = open(path, O_RDONLY | O_NONBLOCK);
    if (pipe.fd < 0)
        return NULL;
    do
        ready = poll(&pipe, 1, -1);
    while (ready < 0 && errno == EINTR);
    if (ready > 0 && fcntl(pipe.fd, F_SETFL, fcntl(pipe.fd, F_GETFL) & ~O_NONBLOCK) == 0)
        stream = fdopen(pipe.fd, "r");
    if (!stream)
        close(pipe.fd);
    return stream;
}
