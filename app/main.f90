!> The command line of faststrip.
program faststrip_main
    use faststrip_app_revision, only: revision
    implicit none

    print '(a)', 'faststrip 0.1.0 rev ' // revision
end program faststrip_main
