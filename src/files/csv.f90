!> Tables of comma-separated values: a strict reader, and a writer that leaves either the whole
!> new file or the old one.
!>
!> The dialect: comment lines start with `#`, above the names with `!` or `%`, too; the first other
!> line names the columns, then one row a line. Cells are separated by what separates the names:
!> commas, else semicolons, else tabulators, else blanks, or what a first line `sep=;` tells; blanks
!> around a cell do not count; a cell in double quotes may hold separators and doubled quotes, but
!> no line break. Numbers have a point. Empty lines are passed over. Line ends LF, CRLF or CR, a
!> byte order mark in front is tolerated, UTF-16 is not.
module faststrip_files_csv
    use faststrip_files_csv_table, only: csv_text_t, csv_table_t, read_csv, column_index, &
                                         require_column, cell_text, cell_number, cell_integer, &
                                         read_cell, column_numbers, several_columns, &
                                         take_only_row, refuse_misspelt
    use faststrip_files_csv_stream, only: csv_stream_t, csv_scan_t, row_place_t, open_stream, &
                                          find_row, row_place, go_to_row, close_stream, scan_csv, &
                                          find_row_place
    use faststrip_files_csv_writer, only: csv_writer_t, open_csv, put_comment, put_header, &
                                          put_cell, put_cells, put_empty_cells, end_row, &
                                          put_line, put_text, close_csv, abort_csv, collect_csv, &
                                          collected, collected_length, forget_collected, &
                                          real_text, failure_words, finish_tables
    use faststrip_files_temporary, only: find_prefix, temporary_ending, most_temporaries, &
                                         name_temporary, find_free_temporary, find_final_path
    implicit none
    private

    public :: csv_text_t, csv_table_t, csv_writer_t
    public :: read_csv, column_index, require_column, cell_text, cell_number, cell_integer
    public :: read_cell, column_numbers, several_columns, take_only_row, refuse_misspelt
    public :: csv_stream_t, csv_scan_t, row_place_t
    public :: open_stream, find_row, row_place, go_to_row, close_stream, scan_csv, find_row_place
    public :: find_prefix, temporary_ending, most_temporaries, name_temporary
    public :: find_free_temporary, find_final_path
    public :: open_csv, put_comment, put_header, put_cell, put_cells, put_empty_cells, end_row
    public :: put_line, put_text
    public :: close_csv, abort_csv, finish_tables
    public :: collect_csv, collected, collected_length, forget_collected
    public :: real_text, failure_words
end module faststrip_files_csv
