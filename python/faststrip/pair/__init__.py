"""One wheel on one rail in one line: a contact, a sweep over the displacement, a creep map."""
