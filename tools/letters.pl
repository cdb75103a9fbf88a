#!/usr/bin/perl
# Writes src/aesl/letters.def on stdout: the characters beyond ASCII that may be in an AESL word
# (docs/spec/aesl-language.md, section 1.3), from the Unicode tables that Perl carries.
use strict;
use warnings;
no warnings 'utf8';
use Unicode::UCD;

print "// Characters beyond ASCII that may be in a word: Unicode property Alphabetic or general category Nd, Unicode ",
    Unicode::UCD::UnicodeVersion(), ".\n// Made by tools/letters.pl; never edited by hand.\n";
my ($first, $last);
for my $c (0x80 .. 0x10ffff) {
    next if $c >= 0xd800 && $c <= 0xdfff;
    next unless chr($c) =~ /[\p{Alphabetic}\p{Nd}]/;
    if (defined $last && $last == $c - 1) { $last = $c; next; }
    printf "LETTERS(0x%04x, 0x%04x)\n", $first, $last if defined $last;
    $first = $last = $c;
}
printf "LETTERS(0x%04x, 0x%04x)\n", $first, $last;
