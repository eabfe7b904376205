use topple_pictures::drawing::canvas::Canvas;

use topple_report::document::{Document, Piece};
use topple_report::html::write;

#[test]
fn no_text_becomes_markup() {
    let text = "<script>alert('1')</script> \"&\"".to_string();
    let pieces = vec![
        Piece::Heading(1, text.clone()),
        Piece::Text(text.clone()),
        Piece::List(vec![text.clone()]),
        Piece::Table(vec![text.clone()], vec![vec![text.clone()]]),
        Piece::Picture(Canvas::new(9.0).finish(9.0), text.clone()),
        Piece::Code(vec![text.clone()]),
    ];
    let page = write(&Document { title: text.clone(), pieces });
    assert!(!page.contains("<script"), "{page}");
    assert_eq!(page.matches("&lt;script&gt;alert(&#39;1&#39;)").count(), 10, "{page}");
}
